#pragma once

// Server for phones in the local network: they feel the clip that is played here.

#include <pacini/clip/Clip.h>
#include <pacini/foundation/Result.h>
#include <pacini/foundation/Units.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace pacini::phone
{

struct PhoneServerParams
{
    std::string address;    ///< IPv4 of this machine that is listened on; empty: that which reaches the local network
    std::uint16_t port = 0; ///< 0: any that is free
};

/// Reason for refusing a phone.
enum class Refusal
{
    usedCode,  ///< another phone had its code
    wrongCode, ///< not a code of this session
    full       ///< as many phones as there may be are connected
};

/// What a connected phone does with a clip.
enum class PhoneState
{
    waits, ///< nobody has touched its button yet, and browsers vibrate only then
    feels,
    cannotVibrate
};

/// A connected phone.
struct ConnectedPhone
{
    std::string kind; ///< by its browser: Android, iPhone, iPad or computer
    PhoneState state = PhoneState::waits;

    bool operator==(const ConnectedPhone&) const = default;
};

/// Those phones for people, such as "2 phones connected: 1 Android feels, 1 iPhone cannot vibrate".
[[nodiscard]] std::string phonesText(const std::vector<ConnectedPhone>& phones);

/// The most phones that may be connected at once.
inline constexpr std::size_t mostPhones = 64;

/// For people, in a sentence without its stop.
[[nodiscard]] std::string refusalText(Refusal refusal);

/// A page that vibrates, for browsers that have the pairing code: it is in the address, works once, and is then
/// another. It is used up by a tap on the page that it opens, not by a preview of the link. Nothing else is served but
/// the film that is shown and, to paired browsers on this machine, a picture of the address for the next phone; and
/// only the time of the phone's clock and whether it feels are accepted; unpaired phones are refused. The server runs
/// on its own thread and ends with the object. Protocol: HTTP and WebSocket (RFC 9110, RFC 6455), not encrypted, so for
/// networks that are trusted.
class PhoneServer
{
public:
    /// Errors: `io`, with a message for people. [message]
    [[nodiscard]] static Result<std::unique_ptr<PhoneServer>> start(const PhoneServerParams& params = {});

    virtual ~PhoneServer() = default;

    /// The address with the pairing code that the next phone needs. [any]
    [[nodiscard]] virtual std::string url() const = 0;

    /// How many phones are connected. [any]
    [[nodiscard]] virtual std::size_t phones() const = 0;

    /// Which they are, in the order in which they came. [any]
    [[nodiscard]] virtual std::vector<ConnectedPhone> connectedPhones() const = 0;

    /// How many phones were refused for this reason. [any]
    [[nodiscard]] virtual std::size_t refused(Refusal reason) const = 0;

    /// What is felt from now on; stops what is played. [message]
    virtual void show(const Clip& clip) = 0;

    /// The same with a film, which the page of the phone shows: the clip is played in time with it. The file is read as
    /// browsers ask for it. Errors: `io`, when it cannot be opened. [message]
    [[nodiscard]] virtual Result<void> show(const Clip& clip, const std::filesystem::path& film) = 0;

    /// Says that the clip is played from here on, `from` s after its start, and that this began `ago`. [message]
    virtual void play(Seconds from, Seconds ago = Seconds(0.0)) = 0;
    virtual void stop() = 0;

protected:
    PhoneServer() = default;
};

} // namespace pacini::phone
