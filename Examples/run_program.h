// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <exception>
#include <iostream>

#include <CLI/CLI.hpp>

#include "printable.h"

// What every main does but that of rgbd_tum: reads the command line into Arguments, to which
// `add_arguments` ties it, and runs. Whatever goes wrong is one line on standard error that begins
// with the program's name. Returns the exit code: 1 for errors and wrong usage, else that of `run`.
template <typename Arguments>
int RunProgram(const char* name,
               const char* description,
               int argc,
               char** argv,
               void (*add_arguments)(CLI::App&, Arguments&),
               int (*run)(const Arguments&)) {
  try {
    Arguments arguments;
    CLI::App app(description);
    add_arguments(app, arguments);
    try {
      app.parse(argc, argv);
    } catch (const CLI::Success& help_or_version) {
      return app.exit(help_or_version);
    } catch (const CLI::ParseError& error) {
      std::cerr << name << ": " << Printable(error.what()) << " (--help shows the usage)\n";
      return 1;
    }
    return run(arguments);
  } catch (const std::exception& error) {
    std::cerr << name << ": " << Printable(error.what()) << '\n';
    return 1;
  }
}
