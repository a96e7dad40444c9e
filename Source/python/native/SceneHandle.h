#pragma once

// A scene of the module: an immutable value.

#include <pacini/synthesis/Scene.h>

#include <memory>
#include <utility>

namespace pacini::python
{

class SceneHandle
{
public:
    explicit SceneHandle(Scene scene) : content(std::make_shared<const Scene>(std::move(scene))) {}

    [[nodiscard]] const Scene& scene() const noexcept { return *content; }

private:
    std::shared_ptr<const Scene> content;
};

} // namespace pacini::python
