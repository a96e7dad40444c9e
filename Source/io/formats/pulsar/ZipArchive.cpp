#include "io/formats/pulsar/ZipArchive.h"

#ifdef PACINI_HAS_LIBZIP

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <array>

namespace pacini
{

namespace
{
Error damagedArchive(std::string_view message)
{
    return {ErrorCode::invalidData, "", fmt::format("is no ZIP archive that can be read: {}", message)};
}

Error noArchive()
{
    return {ErrorCode::io, "", "out of memory for the archive"};
}
} // namespace

void ZipArchive::Closer::operator()(zip* archive) const noexcept
{
    zip_discard(archive);
}

Result<ZipArchive> ZipArchive::open(std::string_view bytes)
{
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* const source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
    zip_t* const opened =
        source != nullptr ? zip_open_from_source(source, ZIP_RDONLY | ZIP_CHECKCONS, &error) : nullptr;
    if (opened == nullptr && source != nullptr)
        zip_source_free(source);
    const std::string message = opened == nullptr ? zip_error_strerror(&error) : "";
    zip_error_fini(&error);
    if (opened == nullptr)
        return damagedArchive(message);
    return ZipArchive(opened);
}

Result<std::string> ZipArchive::content(const std::string& name, std::uint64_t most) const
{
    const auto wrong = [&](std::string message, ErrorCode code = ErrorCode::invalidData)
    {
        return Error{code, name, std::move(message)};
    };
    const auto place = zip_name_locate(archive.get(), name.c_str(), 0);
    if (place < 0)
        return wrong("is missing in the archive");
    const std::unique_ptr<zip_file_t, decltype(&zip_fclose)> file(
        zip_fopen_index(archive.get(), static_cast<zip_uint64_t>(place), 0), zip_fclose);
    if (!file)
        return wrong(fmt::format("cannot be read: {}", zip_strerror(archive.get())));
    std::string content;
    std::array<char, 65536> piece;
    for (;;)
    {
        const auto got = zip_fread(file.get(), piece.data(), piece.size());
        if (got < 0)
            return wrong(fmt::format("is damaged: {}", zip_file_strerror(file.get())));
        if (got == 0)
            return content;
        content.append(piece.data(), static_cast<std::size_t>(got));
        if (content.size() > most)
            return wrong(fmt::format("is longer than {} bytes", most), ErrorCode::tooLarge);
    }
}

Result<std::string> zipOf(const std::vector<std::pair<std::string, std::string>>& files)
{
    zip_source_t* const whole = zip_source_buffer_create(nullptr, 0, 0, nullptr);
    if (whole == nullptr)
        return noArchive();
    zip_source_keep(whole);
    const std::unique_ptr<zip_source_t, decltype(&zip_source_free)> kept(whole, zip_source_free);
    zip_t* const archive = zip_open_from_source(whole, ZIP_TRUNCATE, nullptr);
    if (archive == nullptr)
    {
        zip_source_free(whole); // what the archive would have owned
        return noArchive();
    }
    constexpr zip_uint16_t firstDay = 0x21; // 1 January 1980, the earliest that a ZIP can say
    for (const auto& [name, content] : files)
    {
        zip_source_t* const source = zip_source_buffer(archive, content.data(), content.size(), 0);
        const auto place = source != nullptr ? zip_file_add(archive, name.c_str(), source, ZIP_FL_ENC_UTF_8) : -1;
        const auto index = static_cast<zip_uint64_t>(std::max<zip_int64_t>(place, 0));
        if (place < 0 || zip_file_set_dostime(archive, index, 0, firstDay, 0) != 0 ||
            zip_set_file_compression(archive, index, ZIP_CM_STORE, 0) != 0)
        {
            if (source != nullptr && place < 0)
                zip_source_free(source);
            zip_discard(archive);
            return noArchive();
        }
    }
    if (zip_close(archive) != 0)
    {
        zip_discard(archive);
        return noArchive();
    }
    zip_stat_t size;
    if (zip_source_open(whole) != 0)
        return noArchive();
    std::string bytes;
    if (zip_source_stat(whole, &size) == 0 && (size.valid & ZIP_STAT_SIZE) != 0)
        bytes.resize(static_cast<std::size_t>(size.size));
    const auto got = zip_source_read(whole, bytes.data(), bytes.size());
    zip_source_close(whole);
    if (bytes.empty() || got != static_cast<zip_int64_t>(bytes.size()))
        return noArchive();
    return bytes;
}

} // namespace pacini

#endif
