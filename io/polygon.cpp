#include "io/polygon.h"

#include <algorithm>
#include <cmath>

namespace candil {

namespace {

using Point = glm::dvec2;

/// Twice the area of a triangle, positive when it is counter-clockwise.
double signed_area(Point a, Point b, Point c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

/// Newell's normal: twice the vector area, hence along the front of concave polygons as well.
glm::dvec3 vector_area(std::span<const Vec3> corners) {
  glm::dvec3 sum(0);
  const glm::dvec3 origin(corners[0]);
  for (std::size_t i = 0; i < corners.size(); ++i)
    sum += glm::cross(glm::dvec3(corners[i]) - origin, glm::dvec3(corners[(i + 1) % corners.size()]) - origin);
  return sum;
}

/// Seen along the axis that the normal is nearest to, with the front towards the viewer.
std::vector<Point> projected(std::span<const Vec3> corners) {
  const glm::dvec3 normal = vector_area(corners), size = glm::abs(normal);
  const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  const int first = (axis + 1) % 3, second = (axis + 2) % 3;
  const double sign = normal[axis] < 0 ? -1 : 1;
  std::vector<Point> points;
  points.reserve(corners.size());
  for (const Vec3 corner : corners) points.emplace_back(sign * corner[first], corner[second]);
  return points;
}

bool never_turns_right(const std::vector<Point>& points) {
  const std::size_t count = points.size();
  for (std::size_t i = 0; i < count; ++i)
    if (signed_area(points[i], points[(i + 1) % count], points[(i + 2) % count]) < 0) return false;
  return true;
}

/// Of an outline that never turns right: whether it goes round once, hence is convex, and not twice as a pentagram
/// does. Its edges then run to the left and to the right once each.
bool goes_round_once(const std::vector<Point>& points) {
  int changes = 0, first = 0, last = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double run = points[(i + 1) % points.size()].x - points[i].x;
    if (run == 0) continue;
    const int direction = run < 0 ? -1 : 1;
    if (last == 0) first = direction;
    if (last != 0 && direction != last) ++changes;
    last = direction;
  }
  return changes + (first != last ? 1 : 0) <= 2;
}

void add_fan(const std::vector<std::uint32_t>& corners, std::vector<Triangle>& triangles) {
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) triangles.emplace_back(corners[0], corners[i], corners[i + 1]);
}

class EarClipper {
 public:
  EarClipper(const std::vector<Point>& points, std::size_t most_tests) : points_(points), tests_left_(most_tests) {
    for (std::uint32_t i = 0; i < points.size(); ++i) left_.push_back(i);
  }

  bool clip(std::vector<Triangle>& triangles) {
    std::size_t at = 0, failures = 0;
    while (left_.size() > 3 && failures < left_.size() && tests_left_ > 0) {
      const Triangle ear = triangle(at);
      if (is_ear(ear)) {
        triangles.push_back(ear);
        left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(at));
        failures = 0;
      } else {
        ++failures;
        ++at;
      }
      at %= left_.size();
    }
    // Ears take their area off the outline's: what is left of one that crosses itself may face backwards.
    const bool is_done = left_.size() == 3 && signed_area(points_[left_[0]], points_[left_[1]], points_[left_[2]]) >= 0;
    add_fan(left_, triangles);
    return is_done;
  }

  std::size_t tests_left() const { return tests_left_; }

 private:
  Triangle triangle(std::size_t at) const {
    const std::size_t count = left_.size();
    return {left_[(at + count - 1) % count], left_[at], left_[(at + 1) % count]};
  }

  bool is_ear(const Triangle& ear) {
    const Point a = points_[ear.x], b = points_[ear.y], c = points_[ear.z];
    if (!(signed_area(a, b, c) > 0)) return false;
    for (const std::uint32_t i : left_) {
      if (tests_left_ == 0) return false;
      --tests_left_;
      const Point p = points_[i];
      if (p == a || p == b || p == c) continue;
      if (signed_area(a, b, p) >= 0 && signed_area(b, c, p) >= 0 && signed_area(c, a, p) >= 0) return false;
    }
    return true;
  }

  const std::vector<Point>& points_;
  std::size_t tests_left_;
  std::vector<std::uint32_t> left_;
};

}  // namespace

bool triangulate_polygon(std::span<const Vec3> corners, std::vector<Triangle>& triangles, std::size_t& tests_left) {
  triangles.clear();
  if (corners.size() == 3) {
    triangles.emplace_back(0, 1, 2);
    return true;
  }
  const std::vector<Point> points = projected(corners);
  if (!never_turns_right(points)) {
    const std::size_t most_tests = std::min(1000 * points.size(), tests_left);
    EarClipper clipper(points, most_tests);
    const bool is_done = clipper.clip(triangles);
    tests_left -= most_tests - clipper.tests_left();
    return is_done;
  }
  for (std::uint32_t i = 1; i + 1 < corners.size(); ++i) triangles.emplace_back(0, i, i + 1);
  return goes_round_once(points);
}

}  // namespace candil
