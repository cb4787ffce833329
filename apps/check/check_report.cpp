#include "apps/check/check_report.h"

#include <fmt/format.h>

#include <span>

#include "apps/base64.h"
#include "apps/check/failure_files.h"
#include "apps/check/failure_page.h"
#include "apps/escape_xml.h"
#include "apps/versions.h"
#include "io/atomic_file.h"
#include "io/error.h"

namespace candil {
namespace {

constexpr const char* style = R"(
body { font: 15px/1.4 system-ui, sans-serif; margin: 2em auto; max-width: 72em; padding: 0 1em; color: #222; background: #fff }
table { border-collapse: collapse; width: 100% }
td, th { text-align: left; padding: .35em .8em .35em 0; border-bottom: 1px solid #ddd; vertical-align: top }
article { border: 1px solid #ddd; border-left: 6px solid #b3261e; border-radius: 4px; padding: .6em 1em; margin: 1em 0 }
figure { display: inline-block; margin: .5em 1em .5em 0 }
figcaption { color: #666 }
img { image-rendering: pixelated; width: 256px; max-width: 100%; background: #888; display: block }
td img { width: 48px }
code { background: #f3f3f3; padding: .1em .3em; overflow-wrap: anywhere }
.bad { color: #b3261e; font-weight: 600 } .good { color: #1b6e2f } .left { color: #8a6100 }
@media (prefers-color-scheme: dark) {
  body { background: #16181b; color: #ddd } code { background: #26292d } td, th, article { border-color: #3a3d42 }
  .bad { color: #ff8a80 } .good { color: #7bd88f } .left { color: #ffcf66 } figcaption { color: #aaa }
})";

std::string image(std::span<const std::byte> png, const std::string& alternative) {
  return fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">", escape_xml(alternative), to_base64(png));
}

std::string figure(std::span<const std::byte> png, const std::string& caption) {
  return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", image(png, caption), caption);
}

std::string findings_table(const Verdict& verdict) {
  std::string rows;
  for (const Finding& finding : verdict.findings)
    rows += fmt::format("<tr><td>{}<td class=\"{}\">{}<td>{} {:.4g}\n", finding.name, finding.is_met ? "good" : "bad",
                        finding.value, finding.is_smallest ? "at least" : "at most", finding.limit);
  return "<table><tr><th>Metric<th>Value<th>Limit\n" + rows + "</table>\n";
}

std::string failure_article(const TestOutcome& outcome) {
  std::string html = fmt::format("<article id=\"{0}\"><h2>{0}</h2>\n<p class=\"bad\">{1}</p>\n",
                                 escape_xml(outcome.test->name), escape_xml(outcome.message));
  if (outcome.golden && outcome.render)
    html += figure(shown_png(outcome.golden->mean, outcome.render->display), "golden image");
  if (outcome.render && !outcome.render->image.mean.empty())
    html += figure(shown_png(outcome.render->image.mean, outcome.render->display), "render");
  if (outcome.verdict && outcome.verdict->flip_map)
    html += figure(heat_png(*outcome.verdict->flip_map), "FLIP, black 0, lightest 1") +
            figure(change_png(outcome.golden->mean, outcome.render->image.mean), "2 % brighter red, darker blue");
  if (outcome.verdict) {
    html += findings_table(*outcome.verdict);
    for (const std::string& note : outcome.verdict->notes) html += "<p>" + escape_xml(note) + "</p>\n";
  }
  if (has_failure_page(outcome))
    html += fmt::format("<p><a href=\"{}\">Look closer</a>: slider, flicker, zoom, values of pixels, exposure</p>\n",
                        failure_page_path(outcome.test->name).generic_string());
  html += "<p>Reproduce: <code>" + escape_xml(outcome.reproduce) + "</code></p>\n";
  if (outcome.status == TestStatus::failed)
    html += "<p>If the new picture is the right one: <code>" + escape_xml(outcome.bless) + "</code></p>\n";
  return html + "</article>\n";
}

std::string passed_row(const TestOutcome& outcome) {
  const bool has_picture = outcome.render && !outcome.render->image.mean.empty();
  const std::string picture =
      has_picture ? image(shown_png(outcome.render->image.mean, outcome.render->display), outcome.test->name) : "";
  const bool is_passed = outcome.is_passed();
  const char* const word = outcome.status == TestStatus::passed_before ? "passed before"
                           : is_passed                                 ? "passed"
                                                                       : "not run";
  return fmt::format("<tr><td>{}<td>{}<td class=\"{}\">{}<td>{:.2f} s<td>{}\n", picture, escape_xml(outcome.test->name),
                     is_passed ? "good" : "left", word, outcome.seconds,
                     outcome.verdict ? escape_xml(describe_findings(*outcome.verdict, false)) : "");
}

/// A page for each failure with pictures; those that earlier runs left of tests that passed now are removed.
void write_failure_pages(const std::filesystem::path& folder, const std::vector<TestOutcome>& outcomes) {
  std::error_code status;
  for (const TestOutcome& outcome : outcomes) {
    const std::filesystem::path path = folder / failure_page_path(outcome.test->name);
    if (has_failure_page(outcome)) {
      std::filesystem::create_directories(path.parent_path(), status);
      if (status) throw OutputError(path.parent_path().string(), status.message());
      write_file_atomically(path, failure_page(outcome));
    } else if (outcome.status != TestStatus::not_run) {
      std::filesystem::remove(path, status);
    }
  }
}

}  // namespace

void write_check_report(const std::filesystem::path& folder, const std::string& suite_name,
                        const std::vector<TestOutcome>& outcomes) {
  std::string articles, rows;
  std::size_t failed = 0;
  for (const TestOutcome* outcome : by_severity(outcomes)) {
    failed += outcome->is_failure();
    (outcome->is_failure() ? articles : rows) +=
        outcome->is_failure() ? failure_article(*outcome) : passed_row(*outcome);
  }
  const std::string title = escape_xml(suite_name);
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width\">\n<title>{0}: {1} of {2} failed</title>\n<style>{3}</style></head><body>\n"
      "<h1>{0}</h1>\n<p><span class=\"{4}\">{1} of {2} tests failed.</span> {5}</p>\n",
      title, failed, outcomes.size(), style, failed > 0 ? "bad" : "good", escape_xml(version_line()));
  html += articles;
  if (!rows.empty()) html += "<table><tr><th><th>Test<th>Result<th>Time<th>Numbers\n" + rows + "</table>\n";
  html += "</body></html>\n";
  write_file_atomically(folder / "index.html", html);
  write_failure_pages(folder, outcomes);
}

}  // namespace candil
