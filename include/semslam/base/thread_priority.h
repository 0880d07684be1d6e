// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

namespace semslam {

// From now on the calling thread leaves the processor to the program's other threads when there are
// more of them than cores. Where the system does not offer that, nothing changes.
void YieldToOtherThreads();

}  // namespace semslam
