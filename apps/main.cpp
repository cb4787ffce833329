/// The `candil` command: takes the command line apart, runs the command, and turns every failure into one line and an
/// exit code.

#include <cstdio>
#include <new>

#include "apps/bench_command.h"
#include "apps/check/check_command.h"
#include "apps/command_line.h"
#include "apps/compare/compare_command.h"
#include "apps/exit_code.h"
#include "apps/fidelity_command.h"
#include "apps/info_command.h"
#include "apps/messages.h"
#include "apps/render_command.h"
#include "apps/tonemap_command.h"
#include "apps/usage_error.h"
#include "io/error.h"

namespace candil {
namespace {

int run(const RenderOptions& options) { return run_render(options); }
int run(const TonemapOptions& options) { return run_tonemap(options); }
int run(const CompareOptions& options) { return run_compare(options); }
int run(const FidelityOptions& options) { return run_fidelity(options); }
int run(const InfoOptions& options) { return run_info(options); }
int run(const BenchOptions& options) { return run_bench(options); }
int run(const CheckOptions& options) { return run_check(options); }
int run(const PrintText& print) {
  std::fputs(print.text.c_str(), stdout);
  return exit_done;
}

int fail(const std::string& message, ExitCode code) {
  print_error(message);
  return code;
}

int guarded_main(int argc, const char* const* argv) {
  try {
    const Command command = parse_command_line(argc, argv);
    return std::visit([](const auto& options) { return run(options); }, command);
  } catch (const UsageError& error) {
    return fail(error.what(), exit_usage);
  } catch (const InputError& error) {
    return fail(error.what(), exit_input);
  } catch (const OutputError& error) {
    return fail(error.what(), exit_output);
  } catch (const std::bad_alloc&) {
    return fail("not enough memory", exit_internal);
  } catch (const std::exception& error) {
    return fail(std::string("internal: ") + error.what(), exit_internal);
  }
}

}  // namespace
}  // namespace candil

int main(int argc, char** argv) { return candil::guarded_main(argc, argv); }
