#include "library/RenderEngine.h"

#include <pacini/runtime/Engine.h>

namespace pacini::library
{

void renderEngine(Engine& engine, std::span<const std::span<float>> channels) noexcept
{
    engine.render(channels);
}

} // namespace pacini::library
