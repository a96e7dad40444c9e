#pragma once

// Writing of a report to an open device file. Not for Windows.

#include "devices/Report.h"

#include <unistd.h>

#if defined(__linux__)
#include <linux/hidraw.h>
#include <sys/ioctl.h>
#endif

namespace pacini::devices
{

/// Below 0, with errno, when it fails. One system call: signal handlers may call it. [any]
inline long writeRawReport(int file, const Report& report) noexcept
{
    const auto bytes = report.content();
#if defined(__linux__)
    if (report.isFeature())
        return ::ioctl(file, HIDIOCSFEATURE(bytes.size()), bytes.data());
#endif
    return ::write(file, bytes.data(), bytes.size());
}

} // namespace pacini::devices
