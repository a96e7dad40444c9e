#if defined(__linux__)

#include "devices/HidrawController.h"

#include "devices/EmergencyStop.h"
#include "devices/RawReport.h"

#include <fcntl.h>
#include <linux/hidraw.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace pacini::devices
{

namespace
{
class HidrawController : public OpenController
{
public:
    explicit HidrawController(int openFile) noexcept : file(openFile), emergency(openFile) {}

    void prepare(const StopReports& stops) override { emergency.arm(stops); }

    Result<void> send(const Report& report) override
    {
        if (EmergencyStop::hasCome())
            return Error{ErrorCode::io, "", "is silent, as the program is about to end"};
        long written = -1;
        do
            written = writeRawReport(file.number, report);
        while (written < 0 && errno == EINTR);
        if (written < 0)
            return controllerError(errno);
        emergency.count();
        return {};
    }

    Result<std::vector<std::byte>> feature(std::uint8_t report, std::size_t bytes) override
    {
        std::vector<std::byte> answer(bytes);
        answer.at(0) = static_cast<std::byte>(report);
        const int length = ::ioctl(file.number, HIDIOCGFEATURE(bytes), answer.data());
        if (length < 0 && errno == EPIPE)
            return Error{ErrorCode::io, "", "does not tell what it can play"};
        if (length < 0)
            return controllerError(errno);
        answer.resize(std::min(static_cast<std::size_t>(length), bytes));
        return answer;
    }

private:
    /// Closes at the end of its life, after all that uses it.
    struct File
    {
        explicit File(int openFile) noexcept : number(openFile) {}
        File(const File&) = delete;
        File& operator=(const File&) = delete;
        ~File() { ::close(number); }
        int number;
    };

    File file;
    EmergencyStop emergency;
};
} // namespace

Error controllerError(int errnoValue)
{
    switch (errnoValue)
    {
    case EACCES:
    case EPERM:
        return {ErrorCode::io, "",
                "may not be opened by this user; as root, copy Pacini's 70-pacini.rules to "
                "/etc/udev/rules.d (for what is no game controller, add the line that is told there), run 'udevadm "
                "control --reload' and connect the controller anew"};
    case EWOULDBLOCK:
    case EBUSY:
        return {ErrorCode::io, "", "is in use by another program; end that first"};
    case ENOENT:
    case ENODEV:
    case ENXIO:
    case EIO:
    case EPIPE:
    case ESHUTDOWN:
        return {ErrorCode::io, "", "does not answer any more; was it unplugged or switched off?"};
    default:
        return {ErrorCode::io, "", std::string("refuses what it is sent (") + std::strerror(errnoValue) + ")"};
    }
}

Result<std::unique_ptr<OpenController>> openHidraw(const std::string& path)
{
    const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
    if (file < 0)
        return controllerError(errno);
    std::unique_ptr<OpenController> controller = std::make_unique<HidrawController>(file);
    if (::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        return controllerError(EWOULDBLOCK);
    return controller;
}

} // namespace pacini::devices

#endif
