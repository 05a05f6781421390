// SPDX-License-Identifier: GPL-3.0-or-later
// The mortise program: dispatches to the subcommands and turns errors into exit codes.
#include <cstdio>
#include <exception>

#include "commands.hpp"
#include "interrupt.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/core/version.hpp"

int main(int argc, char** argv) {
  CLI::App program{
      "Mortise finds how two rigid bodies fit together: protein docking and part mating."};
  program.name("mortise");
  program.set_version_flag("--version", std::string("mortise ") + mortise::kVersion);
  program.require_subcommand(1);
  program.get_formatter()->column_width(34);
  mortise::app::add_assemble(program);
  mortise::app::add_benchmark(program);
  mortise::app::add_collide(program);
  mortise::app::add_decompose(program);
  mortise::app::add_dock(program);
  mortise::app::add_evaluate(program);
  mortise::app::add_export(program);
  mortise::app::add_info(program);
  mortise::app::add_report(program);
  mortise::app::add_mate(program);
  mortise::app::add_rescore(program);
  mortise::app::add_rotations(program);
  mortise::app::add_sum(program);
  mortise::app::add_sweep(program);
  program.footer(
      "Exit codes: 0 done; 1 the input or the options are at fault; 2 internal error;\n"
      "130 stopped by Ctrl-C, with what was done so far saved where the command says so.");
  mortise::app::set_command_line(argc, argv);
  try {
    mortise::app::exit_at_once_on_interrupt("nothing was saved");
    program.parse(argc, argv);
    return 0;
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return program.exit(e);  // --help, --version
    std::fprintf(stderr, "mortise: error: %s\n", e.what());
    return 1;
  } catch (const mortise::app::Interrupted& e) {
    std::fprintf(stderr, "mortise: interrupted: %s\n", e.what());
    return 130;
  } catch (const mortise::InputError& e) {
    std::fprintf(stderr, "mortise: error: %s\n", e.what());
    return 1;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "mortise: internal error: %s\n", e.what());
    return 2;
  }
}
