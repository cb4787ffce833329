#!/usr/bin/env bash
# Dependencies point down only: apps -> io, metrics, bench -> integrators -> materials -> core; io, metrics and the others
# do not know each other. The programs of bench/ may see everything.
# Names every include that breaks this, and heavy libraries outside the layer that may see them.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

status=0

# forbid FOLDER PATTERN REASON [GREP_OPTION...]: no include of FOLDER may match the extended regular expression.
forbid() {
  if grep -rnE --include='*.h' --include='*.cpp' "${@:4}" "^[[:space:]]*#[[:space:]]*include[[:space:]]*[<\"]($2)" "$1"; then
    echo "^ $3"
    status=1
  fi
}

forbid core '(materials|integrators|bench|io|metrics|apps|tests)/' 'core/ knows no other folder'
forbid materials '(integrators|bench|io|metrics|apps|tests)/' 'materials/ knows only core/'
forbid integrators '(bench|io|metrics|apps|tests)/' 'integrators/ knows only materials/ and core/'
forbid bench '(io|metrics|apps|tests)/' 'bench/ knows only integrators/, materials/ and core/' --exclude-dir=programs
forbid io '(materials|integrators|bench|metrics|apps|tests)/' 'io/ knows only core/'
forbid metrics '(materials|integrators|bench|io|apps|tests)/' 'metrics/ knows only core/'
forbid apps 'tests/' 'apps/ does not know tests/'

for folder in core materials integrators bench metrics apps; do
  forbid "$folder" '(OpenImageIO/|tiny_gltf)' 'only io/ sees OpenImageIO and tinygltf'
done
for folder in materials integrators io metrics apps; do
  forbid "$folder" '(embree[34]/|core/embree_)' 'only core/ sees Embree'
done
forbid io 'draco/' 'of io/ only gltf_draco.cpp sees Draco' --exclude='gltf_draco.cpp'
forbid io 'meshoptimizer' 'of io/ only gltf_meshopt.cpp sees meshoptimizer' --exclude='gltf_meshopt.cpp'
forbid bench '(embree[34]/|core/embree_)' 'of bench/ only bare_embree.cpp sees Embree' --exclude='bare_embree.cpp'
forbid core 'embree[34]/' 'only core/embree_* see Embree' --exclude='embree_*'

exit "$status"
