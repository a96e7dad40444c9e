#include "io/AtomicFile.h"

#include <cerrno>
#include <random>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#if defined(_WIN32)
#include <fcntl.h>
#include <io.h>

#include <cwchar>
#else
#include <unistd.h>
#endif

namespace pacini
{

namespace fs = std::filesystem;

namespace
{
/// `.NAME.pacini-XXXXXXXX.tmp` in the folder of `target`, X from 0-9 and a-f.
fs::path temporaryName(const fs::path& target, unsigned number)
{
    // A name may have 255 bytes on most file systems: a long one is cut so that ours still fits.
    constexpr std::size_t longest = 200;
    auto name = target.filename().native();
    if (name.size() > longest)
        name.resize(longest);
    fs::path hidden(".");
    hidden += name;
    hidden += temporaryEnding(number);
    return target.parent_path() / hidden;
}

Error alreadyThere()
{
    return {ErrorCode::io, "", "was created meanwhile and was kept; choose another name"};
}

std::FILE* openStandardOutput()
{
#if defined(_WIN32)
    const int copy = _dup(_fileno(stdout));
    _setmode(copy, _O_BINARY);
    return copy < 0 ? nullptr : _fdopen(copy, "wb");
#else
    const int copy = ::dup(STDOUT_FILENO);
    return copy < 0 ? nullptr : ::fdopen(copy, "wb");
#endif
}
} // namespace

AtomicFile::AtomicFile(FileHandle stream, fs::path temporaryPath, fs::path targetPath, TemporaryEntry entry,
                       Existing existingTarget)
    : file(std::move(stream)),
      temporary(std::move(temporaryPath)),
      target(std::move(targetPath)),
      listed(std::move(entry)),
      existing(existingTarget)
{
}

AtomicFile::~AtomicFile()
{
    if (file)
    {
        file.reset();
        removeTemporary();
    }
}

void AtomicFile::removeTemporary() noexcept
{
    std::error_code ignored;
    if (!temporary.empty())
        fs::remove(temporary, ignored);
}

Result<AtomicFile> AtomicFile::create(const fs::path& wanted, Existing existing)
{
    if (!wanted.has_filename())
        return Error{ErrorCode::invalidArgument, "", "no file name was given"};
    std::error_code unknown;
    const auto status = fs::status(wanted, unknown);
    if (fs::is_directory(status))
        return fileError(EISDIR);
    if (isStream(wanted))
    {
        FileHandle nameless = namelessStream();
        if (!nameless)
            return fileError(errno);
        return AtomicFile(std::move(nameless), {}, wanted, {}, existing);
    }
    if (existing == Existing::keep && fs::exists(fs::symlink_status(wanted, unknown)))
        return alreadyThere();
    if (fs::exists(status) && (status.permissions() & fs::perms(0222)) == fs::perms::none)
        return Error{ErrorCode::io, "", "is marked read-only; choose another name or make it writable"};

    // Renaming onto a link would replace the link: write beside the file that it points to.
    auto target = fs::is_symlink(fs::symlink_status(wanted, unknown)) ? fs::weakly_canonical(wanted, unknown) : wanted;
    if (target.empty())
        target = wanted;
    removeStaleTemporaries(target.parent_path());

    std::random_device random;
    for (int attempt = 0; attempt < 100; ++attempt)
    {
        auto temporary = temporaryName(target, random());
        TemporaryEntry entry(temporary); // listed before it exists: a signal may come in between
        auto stream = createStream(temporary);
        if (!stream && errno == EEXIST)
            continue;
        if (!stream && errno == ENOENT)
            return Error{ErrorCode::io, "", "its folder does not exist; create the folder first"};
        if (!stream)
            return fileError(errno);
        if (!keepTemporary(stream.get()))
            continue; // taken for a stale one before it could be marked
        if (fs::exists(status))
            fs::permissions(temporary, status.permissions(), unknown);
        return AtomicFile(std::move(stream), std::move(temporary), std::move(target), std::move(entry), existing);
    }
    return Error{ErrorCode::io, "", "the folder is full of old .pacini-XXXXXXXX.tmp files; remove them"};
}

bool AtomicFile::write(std::span<const std::byte> bytes) noexcept
{
    // An empty span may be a null pointer, which fwrite must not get.
    if (firstErrno == 0 && !bytes.empty() && std::fwrite(bytes.data(), 1, bytes.size(), file.get()) != bytes.size())
        firstErrno = errno;
    return firstErrno == 0;
}

std::size_t AtomicFile::read(std::span<std::byte> bytes) noexcept
{
    const auto got = std::fread(bytes.data(), 1, bytes.size(), file.get());
    if (std::ferror(file.get()) != 0 && firstErrno == 0)
        firstErrno = errno;
    return got;
}

std::optional<Error> AtomicFile::failure() const
{
    return firstErrno == 0 ? std::nullopt : std::optional(fileError(firstErrno));
}

bool AtomicFile::seek(std::int64_t offset, int origin) noexcept
{
    // Seeking writes out what is buffered, so it can fail as a write does.
    if (!seekStream(file.get(), offset, origin) && firstErrno == 0)
        firstErrno = errno;
    return firstErrno == 0;
}

std::int64_t AtomicFile::tell() const noexcept
{
    return tellStream(file.get());
}

std::int64_t AtomicFile::size() noexcept
{
    const auto here = tell();
    if (here < 0 || !seek(0, SEEK_END))
        return -1;
    const auto end = tell();
    seek(here, SEEK_SET);
    return end;
}

void AtomicFile::putInPlace()
{
    std::error_code failure;
    if (existing == Existing::replace)
        fs::rename(temporary, target, failure);
    else
    {
        // Unlike renaming, linking never replaces. Where there are no hard links, looking first must do.
        fs::create_hard_link(temporary, target, failure);
        if (!failure)
            removeTemporary();
        else if (std::error_code unknown; !fs::exists(fs::symlink_status(target, unknown)))
        {
            failure.clear();
            fs::rename(temporary, target, failure);
        }
        else
            failure = std::make_error_code(std::errc::file_exists);
    }
    firstErrno = failure.default_error_condition().value();
}

void AtomicFile::copyToTarget()
{
    const FileHandle device = isStandardOutput(target) ? FileHandle(openStandardOutput()) : openStream(target, "wb");
    std::vector<std::byte> block(65536);
    bool going = device != nullptr && seekStream(file.get(), 0, SEEK_SET);
    while (going)
    {
        const auto got = std::fread(block.data(), 1, block.size(), file.get());
        going = std::fwrite(block.data(), 1, got, device.get()) == got;
        if (got == 0)
            break;
    }
    if (!going || std::ferror(file.get()) != 0 || std::fflush(device.get()) != 0)
        firstErrno = errno;
}

Result<void> AtomicFile::commit()
{
    if (std::fflush(file.get()) != 0 && firstErrno == 0)
        firstErrno = errno;
    if (firstErrno == 0 && temporary.empty())
        copyToTarget();
    const TemporaryMark mark(file.get());
    if (std::fclose(file.release()) != 0 && firstErrno == 0)
        firstErrno = errno;
    if (firstErrno == 0 && !temporary.empty())
        putInPlace();
    if (firstErrno == 0)
        return {};
    removeTemporary();
    return firstErrno == EEXIST ? alreadyThere() : fileError(firstErrno);
}

Result<std::size_t> writeFileAtomically(const fs::path& path, std::span<const std::byte> bytes, Existing existing)
{
    auto file = AtomicFile::create(path, existing);
    if (!file)
        return file.error();
    file->write(bytes);
    if (auto done = file->commit(); !done)
        return done.error();
    return bytes.size();
}

Result<std::size_t> writeFileAtomically(const fs::path& path, std::string_view text, Existing existing)
{
    return writeFileAtomically(path, std::as_bytes(std::span<const char>(text)), existing);
}

bool isStandardOutput(const fs::path& path)
{
    return path == "-" || path == "/dev/stdout" || path == "/dev/fd/1" || path == "/proc/self/fd/1";
}

bool isStream(const fs::path& path)
{
#if defined(_WIN32)
    if (_wcsicmp(path.filename().c_str(), L"NUL") == 0)
        return true; // in every folder, and said to be a file
#endif
    std::error_code unknown;
    const auto status = fs::status(path, unknown);
    return isStandardOutput(path) || (fs::exists(status) && fs::is_other(status));
}

} // namespace pacini
