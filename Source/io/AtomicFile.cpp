#include "io/AtomicFile.h"

#include <cerrno>
#include <random>
#include <string>
#include <system_error>
#include <utility>

namespace pacini
{

namespace fs = std::filesystem;

namespace
{
/// `.NAME.pacini-XXXX.tmp` in the folder of `target`, X from 0-9 and a-f.
fs::path temporaryName(const fs::path& target, unsigned number)
{
    // A name may have 255 bytes on most file systems: a long one is cut so that ours still fits.
    constexpr std::size_t longest = 200;
    std::string digits(4, '0');
    for (std::size_t i = 0; i < digits.size(); ++i)
        digits[i] = "0123456789abcdef"[(number >> (4 * i)) & 15u];
    auto name = target.filename().native();
    if (name.size() > longest)
        name.resize(longest);
    fs::path hidden(".");
    hidden += name;
    hidden += ".pacini-" + digits + ".tmp";
    return target.parent_path() / hidden;
}
} // namespace

AtomicFile::AtomicFile(FileHandle stream, fs::path temporaryPath, fs::path targetPath, TemporaryEntry entry)
    : file(std::move(stream)),
      temporary(std::move(temporaryPath)),
      target(std::move(targetPath)),
      listed(std::move(entry))
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

Result<AtomicFile> AtomicFile::create(const fs::path& wanted)
{
    if (!wanted.has_filename())
        return Error{ErrorCode::invalidArgument, "", "no file name was given"};
    std::error_code unknown;
    const auto status = fs::status(wanted, unknown);
    if (fs::is_directory(status))
        return fileError(EISDIR);
    if (fs::exists(status) && !fs::is_regular_file(status))
    {
        auto device = openStream(wanted, "wb");
        if (!device)
            return fileError(errno);
        return AtomicFile(std::move(device), {}, wanted, {});
    }
    if (fs::exists(status) && (status.permissions() & fs::perms(0222)) == fs::perms::none)
        return Error{ErrorCode::io, "", "is marked read-only; choose another name or make it writable"};

    // Renaming onto a link would replace the link: write beside the file that it points to.
    auto target = fs::is_symlink(fs::symlink_status(wanted, unknown)) ? fs::weakly_canonical(wanted, unknown) : wanted;
    if (target.empty())
        target = wanted;

    std::random_device random;
    for (int attempt = 0; attempt < 100; ++attempt)
    {
        auto temporary = temporaryName(target, random());
        TemporaryEntry entry(temporary); // listed before it exists: a signal may come in between
        auto stream = openStream(temporary, "wbx");
        if (!stream && errno == EEXIST)
            continue;
        if (!stream && errno == ENOENT)
            return Error{ErrorCode::io, "", "its folder does not exist; create the folder first"};
        if (!stream)
            return fileError(errno);
        if (fs::exists(status))
            fs::permissions(temporary, status.permissions(), unknown);
        return AtomicFile(std::move(stream), std::move(temporary), std::move(target), std::move(entry));
    }
    return Error{ErrorCode::io, "", "the folder is full of old .pacini-XXXX.tmp files; remove them"};
}

bool AtomicFile::write(std::span<const std::byte> bytes) noexcept
{
    // An empty span may be a null pointer, which fwrite must not get.
    if (firstErrno == 0 && !bytes.empty() && std::fwrite(bytes.data(), 1, bytes.size(), file.get()) != bytes.size())
        firstErrno = errno;
    return firstErrno == 0;
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

Result<void> AtomicFile::commit()
{
    if (std::fflush(file.get()) != 0 && firstErrno == 0)
        firstErrno = errno;
    if (std::fclose(file.release()) != 0 && firstErrno == 0)
        firstErrno = errno;
    if (firstErrno == 0 && !temporary.empty())
    {
        std::error_code failure;
        fs::rename(temporary, target, failure);
        firstErrno = failure.default_error_condition().value();
    }
    if (firstErrno == 0)
        return {};
    removeTemporary();
    return fileError(firstErrno);
}

Result<std::size_t> writeFileAtomically(const fs::path& path, std::span<const std::byte> bytes)
{
    auto file = AtomicFile::create(path);
    if (!file)
        return file.error();
    file->write(bytes);
    if (auto done = file->commit(); !done)
        return done.error();
    return bytes.size();
}

Result<std::size_t> writeFileAtomically(const fs::path& path, std::string_view text)
{
    return writeFileAtomically(path, std::as_bytes(std::span(text)));
}

} // namespace pacini
