/// Code that is compiled once for each level of the processor and chosen when the program runs.
///
/// The linker keeps one of all inline functions of one name, whichever file it comes from: one that was compiled for a
/// newer processor must never stand in for that of the rest of the program. So everything that such a file defines is
/// in a namespace of its level, CANDIL_TARGET, which is inline: who includes the headers does not see it.
/// tests/check_targets.sh looks at the objects.
#pragma once

#ifndef CANDIL_TARGET
#define CANDIL_TARGET baseline
#endif
