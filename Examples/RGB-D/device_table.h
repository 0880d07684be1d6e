// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

// Prints the cameras that are plugged in and what they can do to standard output. Throws
// semslam::InputError if there are none, or OpenNI2 does not work.
void PrintDevices();
