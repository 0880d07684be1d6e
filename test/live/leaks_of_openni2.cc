// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// What OpenNI2 2.2.0.33 leaks by itself is not looked for: some lists of its file driver whenever
// it is loaded, and about 1 kB for each camera that is pulled out.
#if defined(__SANITIZE_ADDRESS__)

extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libOpenNI2.so\nleak:libOniFile.so\n";
}

// Drivers stay loaded, so that it can be told whose leaks theirs are.
extern "C" int dlclose(void* library);
extern "C" int dlclose(void* /*library*/) { return 0; }

#endif
