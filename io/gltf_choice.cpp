#include <algorithm>
#include <charconv>

#include "io/error.h"
#include "io/gltf_internal.h"

namespace candil {

std::size_t find_choice(const GltfDocument& document, const char* kind, const std::vector<std::string>& names,
                        const std::string& choice) {
  const auto named = std::find(names.begin(), names.end(), choice);
  if (named != names.end()) return static_cast<std::size_t>(named - names.begin());
  std::size_t index = names.size();
  const char* const end = choice.data() + choice.size();
  const auto [rest, error] = std::from_chars(choice.data(), end, index);
  if (error == std::errc() && rest == end && index < names.size()) return index;
  constexpr std::size_t most_listed = 20;
  std::string known;
  for (std::size_t i = 0; i < std::min(names.size(), most_listed); ++i) {
    known += (i == 0 ? "" : ", ") + std::to_string(i);
    if (!names[i].empty()) known += " " + quoted_text(names[i]);
  }
  if (names.size() > most_listed) known += ", ...";
  document.fail(std::string(kind) + "s", "there is no " + std::string(kind) + " " + quoted_text(choice) +
                                             (known.empty() ? ", the file has none" : "; there are: " + known));
}

}  // namespace candil
