#pragma once

// A clip as the module holds it: a value that never changes, so that arrays can look into it.

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
