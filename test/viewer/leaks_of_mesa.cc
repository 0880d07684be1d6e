// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

// Mesa's drivers and the library that finds them keep some memory to the end of the process.
#if defined(__SANITIZE_ADDRESS__)

extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:_dri.so\nleak:libEGL_mesa.so\nleak:libGLX_mesa.so\nleak:libgallium\n"
         "leak:libLLVM\n";
}

// Drivers stay loaded, so that it can be told whose leaks theirs are.
extern "C" int dlclose(void* library);
extern "C" int dlclose(void* /*library*/) { return 0; }

#endif
