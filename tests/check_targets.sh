#!/usr/bin/env bash
# check_targets.sh LEVEL FUNCTION OBJECT: everything that an object for a newer level of x86-64 offers to the linker is in a namespace
# of that level, so that the linker cannot take it for the rest of the program (see core/bvh/target.h).
set -euo pipefail
level=$1 function=$2 object=$3

symbols=$(nm --demangle --defined-only --extern-only "$object")
[[ $symbols == *"candil::$level::$function"* ]] || {
  echo "$object: does not have $function of $level"
  exit 1
}
strange=$(grep -v "candil::$level::" <<<"$symbols" || true)
[[ -z $strange ]] && exit 0
echo "$object: for $level, but the linker may give these to the rest of the program:"
echo "$strange"
exit 1
