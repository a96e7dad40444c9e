#include "io/ClipJson.h"
#include "io/ClipJsonHandler.h"

#include <utility>

namespace pacini
{

namespace
{
template <typename Text>
Result<Clip> read(Text&& text, std::size_t maximumBytes, ReadWarnings* warnings)
{
    clipJson::Handler handler;
    if (auto parsed = parseJson(text, handler, maximumBytes, warnings); !parsed)
        return parsed.error();
    if (auto valid = validate(handler.draft.clip); !valid)
        return valid.error();
    return std::move(handler.draft.clip);
}
} // namespace

Result<Clip> readClipJson(std::string_view text, std::size_t maximumBytes, ReadWarnings* warnings)
{
    return read(text, maximumBytes, warnings);
}

Result<Clip> readClipJson(std::istream& text, std::size_t maximumBytes, ReadWarnings* warnings)
{
    return read(text, maximumBytes, warnings);
}

} // namespace pacini
