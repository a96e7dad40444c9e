#pragma once

// Tags and comments of audio files byte by byte, as their specifications have them.

#include "io/AudioBytes.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace pacini::test
{

/// A list of comments of Vorbis, Opus and FLAC.
inline std::string commentBytes(const std::vector<std::string>& comments)
{
    const std::string vendor = "tests";
    std::string bytes = littleEndian(vendor.size(), 4) + vendor + littleEndian(comments.size(), 4);
    for (const std::string& comment : comments)
        bytes += littleEndian(comment.size(), 4) + comment;
    return bytes;
}

/// The FLAC file with a block of comments as its second block of metadata.
inline std::string flacWithComments(std::string flac, const std::string& comments)
{
    constexpr std::size_t first = 4 + 4 + 34;
    return flac.insert(first, std::string(1, '\4') + bigEndian(comments.size(), 3) + comments);
}

struct OggPage
{
    std::string head;                 ///< 26 bytes, up to the number of segments
    std::vector<std::string> packets; ///< or parts of such
    bool lastGoesOn = false;
};

inline std::vector<OggPage> oggPages(const std::string& bytes)
{
    std::vector<OggPage> pages;
    for (std::size_t at = 0; at + 27 <= bytes.size();)
    {
        OggPage page{bytes.substr(at, 26), {""}, false};
        const auto count = static_cast<unsigned char>(bytes[at + 26]);
        auto content = at + 27 + count;
        for (std::size_t i = 0; i < count; ++i)
        {
            const auto length = static_cast<unsigned char>(bytes[at + 27 + i]);
            page.packets.back() += bytes.substr(content, length);
            content += length;
            page.lastGoesOn = length == 255;
            if (length < 255)
                page.packets.emplace_back();
        }
        if (!page.lastGoesOn)
            page.packets.pop_back();
        pages.push_back(std::move(page));
        at = content;
    }
    return pages;
}

/// The same page with a checksum that is right (RFC 3533, 6).
inline std::string withOggChecksum(std::string page)
{
    page.replace(22, 4, 4, '\0');
    std::uint32_t sum = 0;
    for (const char c : page)
    {
        sum ^= static_cast<std::uint32_t>(static_cast<unsigned char>(c)) << 24u;
        for (int bit = 0; bit < 8; ++bit)
            sum = sum << 1u ^ ((sum & 0x80000000u) != 0 ? 0x04C11DB7u : 0u);
    }
    return page.replace(22, 4, littleEndian(sum, 4));
}

inline std::string oggPageBytes(std::string head, const std::string& lengths, const std::string& content,
                                std::uint32_t number)
{
    head.replace(18, 4, littleEndian(number, 4));
    return withOggChecksum(head + static_cast<char>(lengths.size()) + lengths + content);
}

/// The Ogg file with other comments, on as many pages as they need.
inline std::string oggWithComments(const std::string& ogg, const std::string& comments)
{
    auto pages = oggPages(ogg);
    std::string& packet = pages.at(1).packets.at(0);
    packet = packet.starts_with("Opus") ? "OpusTags" + comments : "\3vorbis" + comments + '\1';
    std::string bytes;
    std::uint32_t number = 0;
    for (const OggPage& page : pages)
    {
        std::string lengths, content, head = page.head;
        for (std::size_t i = 0; i < page.packets.size(); ++i)
        {
            const bool goesOn = page.lastGoesOn && i + 1 == page.packets.size();
            std::size_t left = page.packets[i].size(), from = 0;
            for (bool ends = false; !ends;)
            {
                const std::size_t length = left < 255 ? left : 255;
                lengths += static_cast<char>(length);
                content += page.packets[i].substr(from, length);
                from += length;
                left -= length;
                ends = length < 255 || (goesOn && left == 0);
                if (lengths.size() == 255 && (!ends || i + 1 < page.packets.size()))
                {
                    bytes += oggPageBytes(head, lengths, content, number++);
                    lengths.clear();
                    content.clear();
                    head[5] = static_cast<char>(ends ? 0 : 1); // whether it goes on with a packet
                }
            }
        }
        bytes += oggPageBytes(head, lengths, content, number++);
    }
    return bytes;
}

/// 28 bits in four bytes.
inline std::string sevenBits(std::uint32_t value)
{
    std::string bytes;
    for (int shift = 21; shift >= 0; shift -= 7)
        bytes += static_cast<char>(value >> shift & 0x7Fu);
    return bytes;
}

inline std::string id3Frame(const std::string& name, const std::string& content, int version, unsigned flags = 0)
{
    const auto size = static_cast<std::uint32_t>(content.size());
    return name + (version == 4 ? sevenBits(size) : bigEndian(size, 4)) + bigEndian(flags, 2) + content;
}

/// A chapter; `title` is what a frame of text holds, its encoding included, or empty for none.
inline std::string id3Chapter(const std::string& id, std::uint32_t ms, const std::string& title, int version)
{
    return id3Frame("CHAP",
                    id + '\0' + bigEndian(ms, 4) + bigEndian(ms + 100, 4) + bigEndian(0xFFFFFFFF, 4) +
                        bigEndian(0xFFFFFFFF, 4) + (title.empty() ? "" : id3Frame("TIT2", title, version)),
                    version);
}

inline std::string id3Tag(const std::string& frames, int version, unsigned flags = 0)
{
    return "ID3" + bigEndian(static_cast<unsigned>(version), 1) + '\0' + bigEndian(flags, 1) +
           sevenBits(static_cast<std::uint32_t>(frames.size())) + frames;
}

} // namespace pacini::test
