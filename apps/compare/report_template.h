/// The files of the HTML report, compiled in. Marks like {{data}} in the first one stand for what a report fills in.
#pragma once

namespace candil {

extern const char* const report_html;
extern const char* const report_css;
extern const char* const report_js;

}  // namespace candil
