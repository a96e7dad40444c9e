// Any text is either refused with a proper error or is a clip that survives being written and read again.

#include "FuzzCheck.h"
#include "io/ClipJson.h"

#include <istream>
#include <streambuf>
#include <string_view>

using namespace pacini;

namespace
{
/// The text as a stream, without a copy.
class TextBuffer : public std::streambuf
{
public:
    explicit TextBuffer(std::string_view text)
    {
        // setg wants char*, but nothing is put back.
        auto* start = const_cast<char*>(text.data());
        setg(start, start, start + text.size());
    }
};
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto clip = readClipJson(text);

    TextBuffer buffer(text);
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
