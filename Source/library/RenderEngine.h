#pragma once

// Engine::render() for pacini.cpp, which is compiled for size.

#include <span>

namespace pacini
{
class Engine;
}

namespace pacini::library
{

/// engine.render(channels), compiled for speed. [audio]
void renderEngine(Engine& engine, std::span<const std::span<float>> channels) noexcept;

} // namespace pacini::library
