/// What a camera ray meets first, for views and images that describe the scene rather than its light.
#pragma once

#include "integrators/integrator.h"
#include "materials/bsdf.h"

namespace candil {

struct FirstHit {
  Vec3 position;  ///< On the triangle or shape; metres, world space.
  Bsdf bsdf;      ///< The closure that integrators of paths see there.
  Vec3 albedo;    ///< Of the closure, plus what the surface emits, at most 1: lamps are white, unlit surfaces have
                  ///< their colour.
};

FirstHit make_first_hit(const RenderContext& context, const Ray& ray, const Hit& hit);

}  // namespace candil
