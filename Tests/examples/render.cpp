// Clip to drive: render < clip.pacb > drive.f32, mono at 48 kHz

#include <pacini/pacini.h>

#include <cstdio>
#include <span>
#include <utility>
#include <vector>

int main()
{
    std::vector<std::byte> bytes;
    for (int c = std::getchar(); c != EOF; c = std::getchar())
        bytes.push_back(static_cast<std::byte>(c));
    const auto clip = pacini::unpackClip(bytes);
    if (!clip)
        return std::fprintf(stderr, "render: %s\n", clip.error().text().c_str()), 1;

    // A clip is a scene of one play; the plan leaves out what is not felt. With a profile it would fit an actuator.
    pacini::Scene scene;
    scene.clips = {*clip};
    scene.plays = {pacini::ScenePlay{}};
    auto plan = pacini::compilePlan(scene);
    if (!plan)
        return std::fprintf(stderr, "render: %s\n", plan.error().text().c_str()), 1;

    pacini::ScenePlayer player(std::move(*plan));
    std::vector<float> drive(static_cast<std::size_t>(player.totalFrames()));
    const std::span<float> channel = drive;
    player.process(std::span(&channel, 1));
    return std::fwrite(drive.data(), sizeof(float), drive.size(), stdout) == drive.size() ? 0 : 1;
}
