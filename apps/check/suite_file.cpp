#include "apps/check/suite_file.h"

#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "apps/check/suite_keys.h"
#include "apps/render_arguments.h"
#include "apps/usage_error.h"

namespace candil {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t max_file_bytes = std::uintmax_t{1} << 22;
constexpr std::size_t max_tests = 10000, max_name_length = 100;
constexpr double longest_seconds = 86400;

/// What tests inherit.
struct Defaults {
  std::vector<std::string> words;
  fs::path golden_folder = "golden";
  CheckThresholds thresholds;
  double time_limit_seconds = 60;
};

std::string read_text_file(const fs::path& path) {
  std::error_code status;
  if (!fs::exists(path, status)) throw InputError(path.string(), "", "no such file");
  if (!fs::is_regular_file(path, status)) throw InputError(path.string(), "", "not a regular file");
  if (fs::file_size(path, status) > max_file_bytes || status) throw InputError(path.string(), "", "larger than 4 MiB");
  std::ifstream stream(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream) throw InputError(path.string(), "", "cannot be read");
  return text;
}

toml::table parse(const fs::path& file, const std::string& text) {
  try {
    return toml::parse(text, file.string());
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}", file.string(), error.source().begin.line), "",
                     one_line(printable(std::string(error.description()))));
  }
}

/// A path that stays in the suite's folder, also by links.
fs::path inside(const TomlTable& table, std::string_view key, const fs::path& folder, const fs::path& named) {
  const toml::node* const node = table.find(key);
  const auto refuse = [&](const char* why) {
    const std::string message = fmt::format("{}: {}", named.string(), why);
    node ? table.fail(key, *node, message) : table.fail(message);
  };
  if (named.empty() || named.is_absolute()) refuse("must be a path relative to the suite file");
  for (const fs::path& part : named)
    if (part == "..") refuse("must stay in the folder of the suite file");
  const fs::path path = folder / named;
  std::error_code status;
  const auto resolved = [&](const fs::path& p) { return fs::weakly_canonical(fs::absolute(p), status); };
  const fs::path relative = resolved(path).lexically_relative(resolved(folder.empty() ? fs::path(".") : folder));
  if (status || relative.empty() || *relative.begin() == "..")
    refuse("a link leads out of the folder of the suite file");
  return path;
}

bool is_name(std::string_view text) {
  const auto is_allowed = [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           c == '.';
  };
  return !text.empty() && text.size() <= max_name_length && text.front() != '.' && text.front() != '-' &&
         std::ranges::all_of(text, is_allowed);
}

std::string read_name(const TomlTable& table, std::string_view key, const toml::node& node, std::string name) {
  if (!is_name(name))
    table.fail(key, node,
               fmt::format("'{}': a name is 1 to {} letters, digits, '_', '-' or '.', not beginning with '-' or '.'",
                           name, max_name_length));
  return name;
}

/// "flip:p99": a metric, or a quantile of its map.
std::optional<Measure> measure_from_name(const std::string& name) {
  const std::size_t colon = name.find(':');
  const std::optional<Metric> metric = metric_from_name(name.substr(0, colon));
  if (!metric) return std::nullopt;
  if (colon == std::string::npos) return Measure{*metric};
  if (!has_map(*metric)) return std::nullopt;
  const std::string quantile = name.substr(colon + 1);
  if (quantile == "max") return Measure{*metric, 1};
  if (quantile == "min") return Measure{*metric, 0};
  if (quantile == "median") return Measure{*metric, 0.5};
  const bool is_percentile =
      quantile.size() > 1 && quantile[0] == 'p' &&
      std::ranges::all_of(quantile.substr(1), [](char c) { return (c >= '0' && c <= '9') || c == '.'; });
  if (!is_percentile) return std::nullopt;
  char* end = nullptr;
  const double percent = std::strtod(quantile.c_str() + 1, &end);
  if (*end != 0 || !(percent >= 0 && percent <= 100)) return std::nullopt;
  return Measure{*metric, percent / 100};
}

void read_thresholds(const TomlTable& owner, CheckThresholds& thresholds) {
  const std::optional<TomlTable> table = owner.table("threshold");
  if (!table) return;
  table->for_each_key([&](const std::string& key, const toml::node& node) {
    if (key == "ztest") return void(thresholds.z_test = *table->number(key, 0, 1));
    if (key == "signs") return void(thresholds.sign_test = *table->number(key, 0, 1));
    if (key == "flip") return void(thresholds.flip = *table->number(key, 0, 1));
    const std::optional<Measure> measure = measure_from_name(key);
    if (!measure) table->fail(key, node, "is no metric; see `candil compare --help`");
    const Threshold threshold{*measure, *table->number(key, -1e30, 1e30)};
    std::erase_if(thresholds.others, [&](const Threshold& other) { return other.measure == *measure; });
    thresholds.others.push_back(threshold);
  });
}

Defaults read_defaults(const Suite& suite, const TomlTable& root) {
  Defaults defaults;
  const std::optional<TomlTable> table = root.table("defaults");
  if (!table) return defaults;
  table->allow_only({"args", "golden_folder", "threshold", "time_limit"});
  if (auto words = table->texts("args")) defaults.words = std::move(*words);
  if (const auto folder = table->text("golden_folder")) {
    inside(*table, "golden_folder", suite.folder(), *folder);
    defaults.golden_folder = *folder;
  }
  if (const auto seconds = table->number("time_limit", 0.001, longest_seconds)) defaults.time_limit_seconds = *seconds;
  read_thresholds(*table, defaults.thresholds);
  return defaults;
}

/// Options that a suite decides itself, or that would make renders depend on the machine.
constexpr std::string_view refused_options[] = {"--output",       "--stats", "--quiet",   "--aov",
                                                "--aov-separate", "--time",  "--threads", "--frames"};

/// Throws InputError for what `candil render` would not take.
void check_words(const TomlTable& table, const Suite& suite, SuiteTest& test) {
  const toml::node* const node = table.find("args");
  const auto refuse = [&](const std::string& message) {
    node ? table.fail("args", *node, message) : table.fail(message);
  };
  try {
    std::vector<std::string> all = test.words;
    all.push_back(test.scene.string());
    const RenderOptions options = parse_render_words(all);
    if (options.scene != test.scene) refuse("must hold options alone; the scene has its own key");
    for (const std::string_view refused : refused_options)
      if (options.given.contains(std::string(refused))) refuse(fmt::format("{} is not for suites", refused));
    if (!options.environment.image.empty())
      test.environment = inside(table, "args", suite.folder(), options.environment.image).string();
  } catch (const UsageError& error) {
    refuse(error.what());
  }
}

SuiteTest read_test(const Suite& suite, const TomlTable& table, const Defaults& defaults) {
  table.allow_only({"name", "scene", "golden", "args", "tags", "threshold", "time_limit"});
  SuiteTest test;
  const std::optional<std::string> name = table.text("name"), scene = table.text("scene");
  if (!name) table.fail("has no name");
  if (!scene) table.fail("has no scene");
  test.name = read_name(table, "name", *table.find("name"), *name);
  test.scene = inside(table, "scene", suite.folder(), *scene);
  const std::optional<std::string> golden = table.text("golden");
  const fs::path golden_name = golden ? fs::path(*golden) : defaults.golden_folder / (test.name + ".exr");
  test.golden = inside(table, "golden", suite.folder(), golden_name);
  if (test.golden.extension() != ".exr") table.fail("golden", *table.find("golden"), "must be an .exr file");
  test.words = defaults.words;
  if (const auto own = table.texts("args")) test.words.insert(test.words.end(), own->begin(), own->end());
  check_words(table, suite, test);
  const auto tags = table.texts("tags").value_or(std::vector<std::string>());
  std::set<std::string> sorted;
  for (const std::string& tag : tags) sorted.insert(read_name(table, "tags", *table.find("tags"), tag));
  test.tags.assign(sorted.begin(), sorted.end());
  test.thresholds = defaults.thresholds;
  read_thresholds(table, test.thresholds);
  test.time_limit_seconds = table.number("time_limit", 0.001, longest_seconds).value_or(defaults.time_limit_seconds);
  return test;
}

}  // namespace

Suite read_suite(const fs::path& file) {
  const toml::table document = parse(file, read_text_file(file));
  Suite suite{file, {}};
  const TomlTable root(suite.file, "", document);
  root.allow_only({"defaults", "test"});
  const Defaults defaults = read_defaults(suite, root);
  const toml::node* const tests = root.find("test");
  if (!tests) root.fail("has no [[test]]");
  if (!tests->is_array() || tests->as_array()->empty() || !tests->as_array()->is_homogeneous<toml::table>())
    root.fail("test", *tests, "must be written as [[test]]");
  if (tests->as_array()->size() > max_tests) root.fail("test", *tests, "more than 10000 of them");
  std::map<std::string, std::size_t> names;
  std::set<fs::path> goldens;
  for (const toml::node& node : *tests->as_array()) {
    const std::size_t index = suite.tests.size();
    const TomlTable table(suite.file, fmt::format("test[{}]", index), *node.as_table());
    SuiteTest test = read_test(suite, table, defaults);
    if (const auto [at, is_new] = names.emplace(test.name, index); !is_new)
      table.fail("name", *table.find("name"), fmt::format("'{}' is the name of test[{}] too", test.name, at->second));
    test.makes_golden = goldens.insert(test.golden.lexically_normal()).second;
    suite.tests.push_back(std::move(test));
  }
  return suite;
}

}  // namespace candil
