#pragma once

// A clip of the module: an immutable value, so that arrays can refer to it.

#include <pacini/clip/Clip.h>

#include <memory>
#include <utility>

namespace pacini::python
{

class ClipHandle
{
public:
    explicit ClipHandle(Clip clip) : content(std::make_shared<const Clip>(std::move(clip))) {}

    [[nodiscard]] const Clip& clip() const noexcept { return *content; }
    [[nodiscard]] const std::shared_ptr<const Clip>& shared() const noexcept { return content; }

private:
    std::shared_ptr<const Clip> content;
};

} // namespace pacini::python
