#!/usr/bin/env bash
# Dependencies point down only: apps -> io, metrics, integrators -> materials -> core; io, metrics and integrators do not
# know each other.
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

forbid core '(materials|integrators|io|metrics|apps|tests)/' 'core/ knows no other folder'
forbid materials '(integrators|io|metrics|apps|tests)/' 'materials/ knows only core/'
forbid integrators '(io|metrics|apps|tests)/' 'integrators/ knows only materials/ and core/'
forbid io '(materials|integrators|metrics|apps|tests)/' 'io/ knows only core/'
forbid metrics '(materials|integrators|io|apps|tests)/' 'metrics/ knows only core/'
forbid apps 'tests/' 'apps/ does not know tests/'

for folder in core materials integrators metrics apps; do
  forbid "$folder" '(OpenImageIO/|tiny_gltf)' 'only io/ sees OpenImageIO and tinygltf'
done
for folder in materials integrators io metrics apps; do
  forbid "$folder" '(embree[34]/|core/embree_)' 'only core/ sees Embree'
done
forbid core 'embree[34]/' 'only core/embree_* see Embree' --exclude='embree_*'

exit "$status"
