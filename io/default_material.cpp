#include "io/default_material.h"

namespace candil {

Material default_material() {
  Material grey;
  grey.name = "default";
  grey.base_color = Vec4(0.5f, 0.5f, 0.5f, 1);
  grey.metallic = grey.specular = 0;  // without a specular part, the glTF model is Lambert's
  grey.is_double_sided = true;
  return grey;
}

}  // namespace candil
