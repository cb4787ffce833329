/// Text in XML, SVG and HTML.
#pragma once

#include <string>
#include <string_view>

namespace candil {

/// `text` as markup may hold it, also inside of quotes: `&`, `<`, `>` and quotes are escaped, bytes that are no UTF-8
/// and characters that XML does not know become '?'.
std::string escape_xml(std::string_view text);

}  // namespace candil
