#include "devices/OpenController.h"

#include <cerrno>
#include <cstring>

#if defined(__linux__)
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#endif

namespace pacini::devices
{

Error controllerError(int errnoValue)
{
    switch (errnoValue)
    {
    case EACCES:
    case EPERM:
        return {ErrorCode::io, "",
                "may not be opened by this user; as root, copy Pacini's Resources/udev/70-pacini.rules to "
                "/etc/udev/rules.d, run 'udevadm control --reload' and connect the controller anew"};
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

#if defined(__linux__)

Result<std::unique_ptr<OpenController>> OpenController::open(const std::string& path)
{
    const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
    if (file < 0)
        return controllerError(errno);
    std::unique_ptr<OpenController> controller(new OpenController(file));
    if (::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        return controllerError(EWOULDBLOCK);
    return controller;
}

OpenController::File::~File()
{
    ::close(number);
}

Result<void> OpenController::send(const Report& report)
{
    if (EmergencyStop::hasCome())
        return Error{ErrorCode::io, "", "is silent, as the program is about to end"};
    const auto bytes = report.content();
    ::ssize_t written = -1;
    do
        written = ::write(file.number, bytes.data(), bytes.size());
    while (written < 0 && errno == EINTR);
    if (written < 0)
        return controllerError(errno);
    emergency.count();
    return {};
}

#else

Result<std::unique_ptr<OpenController>> OpenController::open(const std::string&)
{
    return Error{ErrorCode::io, "", "can be played on by Pacini on Linux only so far"};
}

OpenController::File::~File() = default;

Result<void> OpenController::send(const Report&)
{
    return controllerError(ENODEV);
}

#endif

OpenController::~OpenController() = default;

} // namespace pacini::devices
