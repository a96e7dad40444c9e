// The module of Pacini's own method: encoding of sounds, and edits over the clips.

#include "web/core/Call.h"

namespace pacini::web
{

std::span<const NamedHandler> handlers()
{
    static constexpr NamedHandler all[]{
        {"encode", encodeSound}, {"reapply", reapplyEdits}, {"parameters", describeParameters}};
    return all;
}

} // namespace pacini::web
