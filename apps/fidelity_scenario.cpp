#include "apps/fidelity_scenario.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "apps/messages.h"
#include "apps/option_values.h"
#include "apps/render_arguments.h"
#include "io/error.h"
#include "io/resource.h"

namespace candil {
namespace {

using nlohmann::json;

/// Members of an object that are read with their place for messages.
class Reader {
 public:
  Reader(const json& object, std::string name, std::string place)
      : object_(object), name_(std::move(name)), place_(std::move(place)) {
    if (!object.is_object()) throw InputError(name_, place_, "must be an object");
  }

  /// Of a member that is missing, a reader of an empty object.
  Reader member(const char* key) const {
    static const json empty = json::object();
    return {has(key) ? object_.at(key) : empty, name_, place_of(key)};
  }
  double number(const char* key, double fallback, double low, double high) const {
    if (!has(key)) return fallback;
    const json& value = object_.at(key);
    if (!value.is_number()) fail(key, "must be a number");
    const double number = value.get<double>();
    if (!(number >= low && number <= high)) fail(key, fmt::format("must be between {:g} and {:g}", low, high));
    return number;
  }
  bool boolean(const char* key, bool fallback) const {
    if (!has(key)) return fallback;
    if (!object_.at(key).is_boolean()) fail(key, "must be true or false");
    return object_.at(key).get<bool>();
  }
  std::string text(const char* key) const {
    if (!has(key)) return {};
    if (!object_.at(key).is_string()) fail(key, "must be a string");
    return object_.at(key).get<std::string>();
  }
  bool has(const char* key) const { return object_.contains(key) && !object_.at(key).is_null(); }
  [[noreturn]] void fail(const char* key, const std::string& message) const {
    throw InputError(name_, place_of(key), message);
  }

 private:
  std::string place_of(const char* key) const { return place_.empty() ? key : place_ + "." + key; }

  const json& object_;
  std::string name_, place_;
};

bool is_json(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string::npos && text[first] == '{';
}

json parse(const std::string& text, const std::string& name) {
  try {
    return json::parse(text);
  } catch (const json::exception& error) {
    throw InputError(name, "JSON", printable(one_line(error.what())).substr(0, 200));
  }
}

/// What the harness wraps in {"scenario": ..., "outputFile": ...}, or that alone.
Scenario to_scenario(const Reader& scenario, const std::string& output) {
  constexpr double farthest = 1e9;
  Scenario result;
  result.model = scenario.text("model");
  if (result.model.empty()) scenario.fail("model", "is missing");
  result.lighting = scenario.text("lighting");
  result.output = output;
  const Reader dimensions = scenario.member("dimensions"), target = scenario.member("target");
  const Reader orbit = scenario.member("orbit");
  result.width = dimensions.number("width", result.width, 1, max_image_side);
  result.height = dimensions.number("height", result.height, 1, max_image_side);
  result.target = {target.number("x", 0, -farthest, farthest), target.number("y", 0, -farthest, farthest),
                   target.number("z", 0, -farthest, farthest)};
  result.theta = orbit.number("theta", result.theta, -1e6, 1e6);
  result.phi = orbit.number("phi", result.phi, 0, 180);
  result.radius = orbit.number("radius", result.radius, 0, farthest);
  result.vertical_fov = scenario.number("verticalFoV", result.vertical_fov, 0.01, 179);
  result.has_skybox = scenario.boolean("renderSkybox", result.has_skybox);
  const Reader path_tracers = scenario.member("pt");
  if (path_tracers.has("numSamples")) {
    result.samples =
        static_cast<std::uint32_t>(path_tracers.number("numSamples", 1, 1, static_cast<double>(max_samples)));
  }
  return result;
}

/// Unit vector from the target to the eye, as THREE.Spherical has it, which keeps as far from the poles.
glm::dvec3 towards_eye(const Scenario& scenario) {
  constexpr double degree = std::numbers::pi / 180, least = 1e-4;
  const double phi = std::clamp(scenario.phi * degree, least, std::numbers::pi - least),
               theta = scenario.theta * degree;
  return {std::sin(phi) * std::sin(theta), std::cos(phi), std::sin(phi) * std::cos(theta)};
}

}  // namespace

glm::dvec3 Scenario::eye() const { return target + radius * towards_eye(*this); }

glm::dvec3 Scenario::aim() const { return radius > 0 ? target : target - towards_eye(*this); }

Scenario read_scenario(const std::string& text, const std::filesystem::path& base) {
  const bool is_inline = is_json(text);
  const std::string name = is_inline ? "scenario" : text;
  std::string content = text;
  if (!is_inline) {
    const Bytes bytes = read_file(text, name, "");
    content.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  const json parsed = parse(content, name);
  const Reader root(parsed, name, "");
  Scenario scenario = to_scenario(root.has("scenario") ? root.member("scenario") : root, root.text("outputFile"));

  const std::filesystem::path usual =
      is_inline ? std::filesystem::path("test/renderers/candil") : std::filesystem::path(text).parent_path();
  for (std::filesystem::path* const path : {&scenario.model, &scenario.lighting})
    if (!path->empty()) *path = ((base.empty() ? usual : base) / *path).lexically_normal();
  return scenario;
}

}  // namespace candil
