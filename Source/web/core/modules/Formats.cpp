// The module of the formats of other programs.

#include "web/core/Call.h"

namespace pacini::web
{

std::span<const NamedHandler> handlers()
{
    static constexpr NamedHandler all[]{
        {"read", readClipBytes}, {"write", writeClipBytes}, {"lint", lintClip}, {"exportParameters", describeExports}};
    return all;
}

} // namespace pacini::web
