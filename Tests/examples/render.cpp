// Clip to drive: render < clip.pacb > drive.f32, mono at 48 kHz

#include <pacini/pacini.h>

#include <cstdio>
#include <vector>

int main()
{
    std::vector<std::byte> bytes;
    for (int c = std::getchar(); c != EOF; c = std::getchar())
        bytes.push_back(static_cast<std::byte>(c));
    const auto clip = pacini::unpackClip(bytes);
    if (!clip)
        return std::fprintf(stderr, "render: %s\n", clip.error().text().c_str()), 1;

    // A clip is a scene of one play. With a profile it would be fitted to an actuator.
    const auto rendered = pacini::renderScene(pacini::sceneOf(*clip), nullptr, {});
    if (!rendered)
        return std::fprintf(stderr, "render: %s\n", rendered.error().text().c_str()), 1;
    const std::vector<float>& drive = rendered->samples;
    return std::fwrite(drive.data(), sizeof(float), drive.size(), stdout) == drive.size() ? 0 : 1;
}
