#pragma once

// A controller that is open for writing.

#include "devices/EmergencyStop.h"
#include "devices/ReportSink.h"

#include <pacini/foundation/Result.h>

#include <memory>
#include <string>

namespace pacini::devices
{

/// Writes to Linux' hidraw node itself instead of through hidapi, which adds nothing there and hides what is needed:
/// the number of the open file, for the last packet of a crash and for the lock, and the reason when something fails.
class OpenController : public ReportSink
{
public:
    /// Opens `path` of connectedControllers() and locks it against other programs that play by Pacini; others are not
    /// kept away. Errors: `io`: no right (the message tells what to do), in use, gone, or not on Linux. [worker]
    [[nodiscard]] static Result<std::unique_ptr<OpenController>> open(const std::string& path);

    ~OpenController() override;

    void prepare(const StopReports& stops) override { emergency.arm(stops); }

    /// Errors: `io`: the controller is gone, or has refused. Returns within seconds, the time that Linux gives a
    /// controller to answer.
    [[nodiscard]] Result<void> send(const Report& report) override;

private:
    /// Closes at the end of its life, after all that uses it.
    struct File
    {
        explicit File(int openFile) noexcept : number(openFile) {}
        File(const File&) = delete;
        File& operator=(const File&) = delete;
        ~File();
        int number;
    };

    explicit OpenController(int openFile) noexcept : file(openFile), emergency(openFile) {}

    File file;
    EmergencyStop emergency;
};

/// Why a controller cannot be opened or written to, by the value of errno. [any]
[[nodiscard]] Error controllerError(int errnoValue);

} // namespace pacini::devices
