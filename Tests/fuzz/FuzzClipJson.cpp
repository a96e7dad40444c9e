// Any text is either refused with a proper error or is a clip that survives being written and read again.

#include "FuzzCheck.h"
#include "FuzzKeys.h"
#include "io/ClipJson.h"

#include <algorithm>
#include <istream>
#include <streambuf>
#include <string_view>

using namespace pacini;

namespace
{
/// The text as a stream that comes in pieces of a few bytes, so that every place is once at the edge of a block.
class TextInPieces : public std::streambuf
{
public:
    explicit TextInPieces(std::string_view wholeText) : text(wholeText) {}

protected:
    std::streamsize xsgetn(char* target, std::streamsize room) override
    {
        // The first piece has room for any byte order mark.
        const std::size_t piece = taken == 0 ? 8 : 1 + taken % 5;
        const auto count = text.copy(target, std::min(piece, static_cast<std::size_t>(room)), taken);
        taken += count;
        return static_cast<std::streamsize>(count);
    }

private:
    std::string_view text;
    std::size_t taken = 0;
};
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    ReadWarnings warnings, strict(true);
    const auto clip = readClipJson(text, largestClipText, &warnings);
    checkWarnings(warnings, clip.ok(), readClipJson(text, largestClipText, &strict).ok());

    TextInPieces buffer(text);
    std::istream stream(&buffer);
    const auto streamed = readClipJson(stream);
    FUZZ_CHECK(streamed.ok() == clip.ok());
    if (!clip)
    {
        FUZZ_CHECK(!clip.error().message.empty());
        FUZZ_CHECK(clip.error().text().find('\n') == std::string::npos);
        FUZZ_CHECK(clip.error().text() == streamed.error().text());
        return 0;
    }
    FUZZ_CHECK(*streamed == *clip);
    FUZZ_CHECK(validate(*clip).ok());
    const auto written = writeClipJson(*clip);
    const auto again = readClipJson(written);
    FUZZ_CHECK(again.ok());
    FUZZ_CHECK(*again == *clip);
    FUZZ_CHECK(writeClipJson(*again) == written);
    return 0;
}
