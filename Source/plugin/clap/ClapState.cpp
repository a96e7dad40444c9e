// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/clap/ClapState.h"

#include "plugin/clap/ClapPlugin.h"

#include <array>
#include <cstdint>

namespace pacini::plugin
{

bool writeAll(const clap_ostream_t& stream, std::string_view bytes)
{
    while (!bytes.empty())
    {
        const std::int64_t written = stream.write(&stream, bytes.data(), bytes.size());
        if (written <= 0 || static_cast<std::uint64_t>(written) > bytes.size())
            return false;
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
}

std::optional<std::string> readAll(const clap_istream_t& stream, std::size_t most)
{
    std::string bytes;
    std::array<char, 4096> some;
    for (;;)
    {
        const std::int64_t count = stream.read(&stream, some.data(), some.size());
        if (count == 0)
            return bytes;
        if (count < 0 || static_cast<std::uint64_t>(count) > some.size() ||
            bytes.size() + static_cast<std::size_t>(count) > most)
            return std::nullopt;
        bytes.append(some.data(), static_cast<std::size_t>(count));
    }
}

const clap_plugin_state_t& stateExtension() noexcept
{
    static constexpr clap_plugin_state_t extension{
        [](const clap_plugin_t* plugin, const clap_ostream_t* stream)
        { return stream != nullptr && stream->write != nullptr && ClapPlugin::of(plugin).save(*stream); },
        [](const clap_plugin_t* plugin, const clap_istream_t* stream)
        {
            return stream != nullptr && stream->read != nullptr && ClapPlugin::of(plugin).load(*stream);
        }};
    return extension;
}

} // namespace pacini::plugin
