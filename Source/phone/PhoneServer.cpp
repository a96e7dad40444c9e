#include "phone/PhoneServer.h"

#include "PhonePage.h"
#include "devices/TouchPlan.h"
#include "io/FileExtension.h"
#include "io/FileHandle.h"
#include "io/JsonTree.h"
#include "phone/PairingCode.h"
#include "phone/QrText.h"

#include <pacini/foundation/ParseNumber.h>

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ip/udp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <functional>
#include <iterator>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace pacini::phone
{

namespace
{
namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using Json = nlohmann::ordered_json;
using boost::system::error_code;
using Tcp = asio::ip::tcp;
using Text = std::shared_ptr<const std::string>;

constexpr std::size_t mostKnown = 1024; // phones and used codes; the oldest are forgotten
constexpr std::size_t codeLength = 16;  // 80 bits
constexpr std::string_view cookieName = "pacini=";

/// ms since the first call.
double clockNow()
{
    static const auto start = std::chrono::steady_clock::now();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// Of this machine in the local network: what it would be reached from elsewhere by. Sends nothing.
Result<std::string> localAddress()
{
    asio::io_context context;
    asio::ip::udp::socket socket(context);
    error_code failed;
    socket.open(asio::ip::udp::v4(), failed);
    // An address for documentation (RFC 5737), which nobody has.
    socket.connect({asio::ip::make_address_v4("192.0.2.1"), 9}, failed);
    if (failed)
        return Error{ErrorCode::io, "", "this machine is in no network; join the one that the phone is in"};
    return socket.local_endpoint().address().to_string();
}

/// A film that is shown; its path is empty when there is none.
struct Film
{
    std::filesystem::path path;
    std::uint64_t bytes = 0;
};

/// Its media type.
std::string_view filmKind(const std::filesystem::path& path)
{
    const std::string extension = lowerExtension(path);
    return extension == ".webm"                         ? "video/webm"
           : extension == ".mkv" || extension == ".mka" ? "video/x-matroska"
           : extension == ".mov"                        ? "video/quicktime"
           : extension == ".mp4" || extension == ".m4v" ? "video/mp4"
           : extension == ".m4a"                        ? "audio/mp4"
                                                        : "application/octet-stream";
}

/// The part of `whole` bytes that a Range field asks for (RFC 9110, section 14), at most so many bytes: its first and
/// the one behind its last; nothing for what cannot be had.
std::optional<std::pair<std::uint64_t, std::uint64_t>> rangeOf(std::string_view field, std::uint64_t whole)
{
    constexpr std::uint64_t most = 1 << 20; // bytes, of which browsers ask for more by themselves
    constexpr std::string_view unit = "bytes=";
    if (whole == 0)
        return {};
    std::uint64_t first = 0, last = whole - 1;
    if (field.starts_with(unit))
    {
        field.remove_prefix(unit.size());
        const auto dash = field.find('-');
        if (dash == std::string_view::npos || field.find(',') != std::string_view::npos)
            return {};
        const auto from = parseNumber<std::uint64_t>(field.substr(0, dash));
        const auto to = parseNumber<std::uint64_t>(field.substr(dash + 1));
        if (!from && !to)
            return {};
        first = from ? *from : whole - std::min(whole, *to);
        last = from && to ? std::min(*to, last) : last;
    }
    if (first > last)
        return {};
    return std::pair(first, std::min(last + 1, first + most));
}

/// State shared by sessions: used only by the thread of the server, unless noted.
class Host
{
public:
    virtual ~Host() = default;
    [[nodiscard]] virtual std::string place() const = 0; ///< host and port, as browsers name it
    [[nodiscard]] virtual std::optional<Refusal> refusalOf(std::string_view code) = 0; ///< counts it
    [[nodiscard]] virtual std::string newCookie() = 0;                                 ///< uses the code up
    [[nodiscard]] virtual bool knows(std::string_view cookies) const = 0;
    [[nodiscard]] virtual const Film& film() const = 0;
    [[nodiscard]] virtual std::string codePicture() const = 0; ///< SVG of the address for the next phone
};

/// Whether the other end of a connection is this machine.
bool isHere(const Tcp::socket& socket)
{
    error_code failed;
    const auto there = socket.remote_endpoint(failed);
    const auto here = failed ? Tcp::endpoint() : socket.local_endpoint(failed);
    return !failed && there.address() == here.address();
}

/// One phone, from its upgrade on.
class Phone : public std::enable_shared_from_this<Phone>
{
public:
    explicit Phone(Tcp::socket&& socket) : isOfThisMachine(isHere(socket)), stream(std::move(socket)) {}

    template <typename Request, typename Ready>
    void accept(const Request& request, Ready ready)
    {
        const auto browser = request[http::field::user_agent];
        about.kind = kindOf({browser.data(), browser.size()});
        constexpr std::size_t longestMessage = 200;
        stream.set_option(beast::websocket::stream_base::timeout::suggested(beast::role_type::server));
        stream.read_message_max(longestMessage);
        stream.async_accept(request,
                            [self = shared_from_this(), ready](error_code failed)
                            {
                                if (failed)
                                    return self->leave();
                                self->open = true;
                                ready();
                                self->read();
                            });
    }

    void send(Text text)
    {
        waiting.push_back(std::move(text));
        if (waiting.size() == 1 && open)
            write();
    }

    /// Says a last thing.
    void sendAway(Text text)
    {
        isLast = true;
        send(std::move(text));
    }

    void close()
    {
        open = false;
        error_code ignored;
        beast::get_lowest_layer(stream).socket().shutdown(Tcp::socket::shutdown_both, ignored);
        beast::get_lowest_layer(stream).close();
    }

    [[nodiscard]] bool isOpen() const noexcept { return open; }
    [[nodiscard]] const ConnectedPhone& what() const noexcept { return about; }
    std::function<void()> ended, changed;
    const bool isOfThisMachine; ///< such as the screen beside the program, which shows the code

private:
    void read()
    {
        stream.async_read(buffer,
                          [self = shared_from_this()](error_code failed, std::size_t)
                          {
                              if (failed || !self->answer())
                                  return self->leave();
                              self->read();
                          });
    }

    /// A phone asks what time it is here, and may say whether it feels; nothing else.
    [[nodiscard]] bool answer()
    {
        const std::string text = beast::buffers_to_string(buffer.data());
        buffer.consume(buffer.size());
        const auto asked = readJsonTree(text, text.size());
        if (!asked || !asked->is_object() || !asked->contains("ping") || !(*asked)["ping"].is_number())
            return false;
        if (asked->size() != 1)
        {
            const auto state =
                asked->size() == 2 && asked->contains("state") ? stateNamed((*asked)["state"]) : std::nullopt;
            if (!state)
                return false;
            if (std::exchange(about.state, *state) != *state && changed)
                changed();
        }
        const Json reply{{"kind", "pong"}, {"ping", (*asked)["ping"].get<double>()}, {"now", clockNow()}};
        send(std::make_shared<const std::string>(reply.dump()));
        return true;
    }

    void write()
    {
        stream.text(true);
        stream.async_write(asio::buffer(*waiting.front()),
                           [self = shared_from_this()](error_code failed, std::size_t)
                           {
                               if (failed)
                                   return self->leave();
                               self->waiting.pop_front();
                               if (!self->waiting.empty())
                                   self->write();
                               else if (self->isLast)
                                   self->close();
                           });
    }

    void leave()
    {
        open = false;
        if (ended)
            std::exchange(ended, {})();
    }

    static std::optional<PhoneState> stateNamed(const Json& name)
    {
        return name == "feels"    ? std::optional(PhoneState::feels)
               : name == "waits"  ? std::optional(PhoneState::waits)
               : name == "cannot" ? std::optional(PhoneState::cannotVibrate)
                                  : std::nullopt;
    }

    /// What a browser says it runs on: one of a few words, as it is shown to people.
    static std::string kindOf(std::string_view browser)
    {
        for (const char* kind : {"Android", "iPhone", "iPad"})
            if (browser.find(kind) != std::string_view::npos)
                return kind;
        return "computer";
    }

    beast::websocket::stream<beast::tcp_stream> stream;
    beast::flat_buffer buffer;
    std::deque<Text> waiting;
    ConnectedPhone about;
    bool open = false;
    bool isLast = false; ///< what is waiting: then it is closed
};

/// One request.
class Visit : public std::enable_shared_from_this<Visit>
{
public:
    using Welcome = std::function<void(const std::shared_ptr<Phone>&, const http::request<http::empty_body>&)>;

    Visit(Tcp::socket&& socket, Host& ofServer, Welcome welcomePhone)
        : stream(std::move(socket)), host(ofServer), welcome(std::move(welcomePhone))
    {
        constexpr std::uint32_t longestHeader = 8192;
        parser.header_limit(longestHeader);
        parser.body_limit(0);
    }

    void run()
    {
        stream.expires_after(std::chrono::seconds(10));
        http::async_read(stream, buffer, parser,
                         [self = shared_from_this()](error_code failed, std::size_t)
                         {
                             if (failed == http::error::body_limit || failed == http::error::unexpected_body)
                                 return self->refuse(http::status::payload_too_large, "Nothing is taken in here.");
                             if (failed == http::error::header_limit)
                                 return self->refuse(http::status::request_header_fields_too_large, "Too much.");
                             if (!failed)
                                 self->answer();
                         });
    }

private:
    using Response = http::response<http::string_body>;

    void answer()
    {
        const auto& request = parser.get();
        const std::string target(request.target());
        constexpr std::string_view pairing = "/?code=";
        const bool isTap = request.method() == http::verb::post && target.starts_with(pairing);
        if (request.method() != http::verb::get && !isTap)
            return refuse(http::status::method_not_allowed, "Nothing is taken in here.");
        // Another name for this machine would be somebody else's page that speaks for it.
        if (std::string(request[http::field::host]) != host.place())
            return refuse(http::status::forbidden, "This is another place.");
        const bool isKnown = host.knows(std::string(request[http::field::cookie]));
        if (target.starts_with(pairing))
        {
            Response response{http::status::see_other, request.version()};
            response.set(http::field::location, "/");
            if (isKnown)
                return send(std::move(response));
            if (const auto refusal = host.refusalOf(std::string_view(target).substr(pairing.size())))
                return refuse(*refusal == Refusal::full ? http::status::service_unavailable : http::status::forbidden,
                              refusalText(*refusal) + ".");
            // What only looks at the address, as previews of links do, has not been scanned by a person.
            if (!isTap)
                return sendFile("/pair.html");
            response.set(http::field::set_cookie,
                         fmt::format("{}{}; Path=/; HttpOnly; SameSite=Lax", cookieName, host.newCookie()));
            return send(std::move(response));
        }
        constexpr std::string_view ofPairing[] = {"/pair.js", "/texts.js", "/phone.css"};
        if (std::find(std::begin(ofPairing), std::end(ofPairing), target) != std::end(ofPairing))
            return sendFile(target);
        if (!isKnown)
            return refuse(http::status::forbidden, "Scan the code that the program shows.");
        if (target == "/events" && beast::websocket::is_upgrade(request))
        {
            if (std::string(request[http::field::origin]) != "http://" + host.place())
                return refuse(http::status::forbidden, "This is another place.");
            stream.expires_never();
            return welcome(std::make_shared<Phone>(stream.release_socket()), request);
        }
        if (target == "/film" && !host.film().path.empty())
            return sendFilm();
        // Who is let in may not let in others: that is for the machine that plays.
        if (target.starts_with("/code.svg") && isHere(stream.socket()))
            return sendCode();
        sendFile(target == "/" ? "/index.html" : target);
    }

    void sendFilm()
    {
        const Film& film = host.film();
        const auto& request = parser.get();
        const std::string asked(request[http::field::range]);
        if (asked.empty()) // browsers ask for parts; this is what saves it
        {
            http::response<http::file_body> whole{http::status::ok, request.version()};
            error_code failed;
            whole.body().open(film.path.string().c_str(), beast::file_mode::scan, failed);
            if (failed)
                return refuse(http::status::not_found, "The film is gone.");
            whole.set(http::field::content_type, std::string(filmKind(film.path)));
            whole.set(http::field::accept_ranges, "bytes");
            stream.expires_after(std::chrono::hours(1));
            return send(std::move(whole));
        }
        const auto range = rangeOf(asked, film.bytes);
        if (!range)
        {
            Response response{http::status::range_not_satisfiable, request.version()};
            response.set(http::field::content_range, fmt::format("bytes */{}", film.bytes));
            return send(std::move(response));
        }
        const auto [first, end] = *range;
        Response response{http::status::partial_content, request.version()};
        response.set(http::field::content_type, std::string(filmKind(film.path)));
        response.set(http::field::accept_ranges, "bytes");
        response.body().resize(static_cast<std::size_t>(end - first));
        const FileHandle file = openStream(film.path, "rb");
        if (!file || !seekStream(file.get(), static_cast<std::int64_t>(first), SEEK_SET))
            return refuse(http::status::not_found, "The film is gone.");
        response.body().resize(std::fread(response.body().data(), 1, response.body().size(), file.get()));
        if (response.body().empty())
            return refuse(http::status::not_found, "The film is gone.");
        response.set(http::field::content_range,
                     fmt::format("bytes {}-{}/{}", first, first + response.body().size() - 1, film.bytes));
        send(std::move(response));
    }

    void sendCode()
    {
        Response response{http::status::ok, parser.get().version()};
        response.set(http::field::content_type, "image/svg+xml");
        response.body() = host.codePicture();
        if (response.body().empty())
            return refuse(http::status::not_found, "Pacini was built without QR codes.");
        send(std::move(response));
    }

    void sendFile(std::string_view name)
    {
        for (const PageFile& file : pageFiles)
            if (file.name == name)
            {
                Response response{http::status::ok, parser.get().version()};
                response.set(http::field::content_type, std::string(file.kind));
                response.body() = std::string(file.text);
                return send(std::move(response));
            }
        refuse(http::status::not_found, "There is nothing here.");
    }

    void refuse(http::status status, std::string_view why)
    {
        Response response{status, 11};
        response.set(http::field::content_type, "text/plain; charset=utf-8");
        response.body() = std::string(why) + "\n";
        response.body()[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(response.body()[0])));
        send(std::move(response));
    }

    template <typename Body>
    void send(http::response<Body>&& response)
    {
        response.set(http::field::cache_control, "no-store");
        response.set(
            "Content-Security-Policy",
            fmt::format(
                "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; media-src 'self'; "
                "connect-src ws://{}; frame-ancestors 'none'; base-uri 'none'; form-action 'self'",
                host.place()));
        response.set("X-Content-Type-Options", "nosniff");
        response.set("Referrer-Policy", "no-referrer");
        response.keep_alive(false);
        response.prepare_payload();
        auto kept = std::make_shared<http::response<Body>>(std::move(response));
        http::async_write(stream, *kept,
                          [self = shared_from_this(), kept](error_code, std::size_t)
                          {
                              error_code ignored;
                              self->stream.socket().shutdown(Tcp::socket::shutdown_send, ignored);
                          });
    }

    beast::tcp_stream stream;
    beast::flat_buffer buffer;
    http::request_parser<http::empty_body> parser;
    Host& host;
    Welcome welcome;
};

class Server final : public PhoneServer, private Host
{
public:
    explicit Server() : acceptor(context), pause(context), code(randomWord(codeLength)) {}

    ~Server() override
    {
        asio::post(context,
                   [this]
                   {
                       error_code ignored;
                       acceptor.close(ignored);
                       for (const auto& phone : connected)
                           phone->close();
                       context.stop();
                   });
        if (thread.joinable())
            thread.join();
    }

    Result<void> listen(const PhoneServerParams& params)
    {
        address = params.address;
        if (address.empty())
        {
            auto found = localAddress();
            if (!found)
                return found.error();
            address = *found;
        }
        error_code failed;
        const auto ip = asio::ip::make_address_v4(address, failed);
        if (failed)
            return Error{ErrorCode::invalidArgument, address, "is no IPv4 address"};
        const Tcp::endpoint where(ip, params.port);
        acceptor.open(where.protocol(), failed);
        acceptor.set_option(asio::socket_base::reuse_address(true), failed);
        failed.clear();
        acceptor.bind(where, failed);
        if (!failed)
            acceptor.listen(asio::socket_base::max_listen_connections, failed);
        if (failed)
            return Error{ErrorCode::io, fmt::format("{}:{}", address, params.port),
                         fmt::format("cannot be listened on: {}", failed.message())};
        port = acceptor.local_endpoint().port();
        accept();
        thread = std::thread([this] { context.run(); });
        return {};
    }

    [[nodiscard]] std::string url() const override
    {
        const std::lock_guard lock(mutex);
        return fmt::format("http://{}/?code={}", place(), code);
    }

    [[nodiscard]] std::size_t phones() const override { return phoneCount; }

    [[nodiscard]] std::vector<ConnectedPhone> connectedPhones() const override
    {
        const std::lock_guard lock(mutex);
        return known;
    }

    [[nodiscard]] std::size_t refused(Refusal reason) const override { return refusals[index(reason)]; }

    void show(const Clip& clip) override { showWith(clip, {}); }

    Result<void> show(const Clip& clip, const std::filesystem::path& film) override
    {
        std::error_code failed;
        const auto bytes = std::filesystem::file_size(film, failed);
        if (failed || !openStream(film, "rb"))
            return Error{ErrorCode::io, film.string(), "cannot be read; check the name and its permissions"};
        showWith(clip, {std::filesystem::absolute(film, failed), bytes});
        return {};
    }

    void showWith(const Clip& clip, Film film)
    {
        const devices::TouchPlan plan = devices::touchPlan(clip);
        const auto milliseconds = [](double seconds)
        {
            return std::llround(1000.0 * seconds);
        };
        Json touches = Json::array();
        for (const devices::Touch& touch : plan.touches)
            touches.push_back({milliseconds(touch.start), milliseconds(touch.end)});
        const Json message{{"kind", "clip"},
                           {"name", clip.name},
                           {"duration", clip.duration},
                           {"longest", devices::longestTouched.value},
                           {"leftOut", plan.leftOut},
                           {"film", !film.path.empty()},
                           {"touches", std::move(touches)}};
        tell(std::make_shared<const std::string>(message.dump(-1, ' ', false, Json::error_handler_t::replace)),
             [this, film = std::move(film)](const Text& text)
             {
                 shown = film;
                 clipText = text;
                 playText.reset();
             });
    }

    void play(Seconds from, Seconds ago) override
    {
        const double now = clockNow();
        tell(std::make_shared<const std::string>(
                 Json{{"kind", "play"}, {"at", now - 1000.0 * ago.value}, {"from", from.value}, {"now", now}}.dump()),
             [this](const Text& text) { playText = text; });
    }

    void stop() override
    {
        tell(std::make_shared<const std::string>(R"({"kind":"stop"})"), [this](const Text&) { playText.reset(); });
    }

private:
    // Host
    [[nodiscard]] std::string place() const override { return fmt::format("{}:{}", address, port); }

    [[nodiscard]] static constexpr std::size_t index(Refusal reason) { return static_cast<std::size_t>(reason); }
    [[nodiscard]] bool isFull() const { return connected.size() >= mostPhones; }

    [[nodiscard]] std::optional<Refusal> refusalOf(std::string_view given) override
    {
        std::optional<Refusal> refusal;
        if (!isSameSecret(given, code)) // only this thread changes it
            refusal = isAmong(usedCodes, given) ? Refusal::usedCode : Refusal::wrongCode;
        else if (isFull())
            refusal = Refusal::full;
        if (refusal)
            ++refusals[index(*refusal)];
        return refusal;
    }

    [[nodiscard]] std::string newCookie() override
    {
        remember(usedCodes, code);
        {
            const std::lock_guard lock(mutex);
            code = randomWord(codeLength);
        }
        ++codeNumber;
        for (const auto& phone : connected)
            if (phone->isOpen())
                sendCode(*phone);
        return remember(cookies, randomWord(2 * codeLength));
    }

    static const std::string& remember(std::deque<std::string>& secrets, std::string secret)
    {
        if (secrets.size() >= mostKnown)
            secrets.pop_front();
        return secrets.emplace_back(std::move(secret));
    }

    [[nodiscard]] static bool isAmong(const std::deque<std::string>& secrets, std::string_view given)
    {
        return std::any_of(secrets.begin(), secrets.end(),
                           [&](const std::string& secret) { return isSameSecret(secret, given); });
    }

    [[nodiscard]] const Film& film() const override { return shown; }
    [[nodiscard]] std::string codePicture() const override { return qrSvg(qrModules(url())); }

    /// Tells a browser on this machine that there is a code to show, if codes can be drawn.
    void sendCode(Phone& phone) const
    {
        if (phone.isOfThisMachine && !qrModules("").empty())
            phone.send(std::make_shared<const std::string>(Json{{"kind", "code"}, {"number", codeNumber}}.dump()));
    }

    [[nodiscard]] bool knows(std::string_view header) const override
    {
        for (auto at = header.find(cookieName); at != std::string_view::npos; at = header.find(cookieName, at + 1))
        {
            if (isAmong(cookies, header.substr(at + cookieName.size(), 2 * codeLength)))
                return true;
        }
        return false;
    }

    void accept()
    {
        acceptor.async_accept(
            [this](error_code failed, Tcp::socket socket)
            {
                if (!acceptor.is_open())
                    return;
                if (failed) // too many files are open, for one: not again at once
                {
                    pause.expires_after(std::chrono::milliseconds(100));
                    pause.async_wait(
                        [this](error_code stopped)
                        {
                            if (!stopped && acceptor.is_open())
                                accept();
                        });
                    return;
                }
                std::make_shared<Visit>(std::move(socket), static_cast<Host&>(*this),
                                        [this](const std::shared_ptr<Phone>& phone, const auto& request)
                                        { welcome(phone, request); })
                    ->run();
                accept();
            });
    }

    void welcome(const std::shared_ptr<Phone>& phone, const http::request<http::empty_body>& request)
    {
        Phone* raw = phone.get();
        if (isFull())
        {
            ++refusals[index(Refusal::full)];
            return phone->accept(request,
                                 [raw] {
                                     raw->sendAway(std::make_shared<const std::string>(
                                         Json{{"kind", "full"}, {"most", mostPhones}}.dump()));
                                 });
        }
        phone->ended = [this, raw]
        {
            connected.erase(
                std::remove_if(connected.begin(), connected.end(), [raw](const auto& one) { return one.get() == raw; }),
                connected.end());
            note();
        };
        phone->changed = [this]
        {
            note();
        };
        connected.push_back(phone);
        phone->accept(request,
                      [this, raw]
                      {
                          note();
                          sendCode(*raw);
                          for (const Text& text : {clipText, playText})
                              if (text)
                                  raw->send(text);
                      });
    }

    /// Takes down who is connected, for other threads.
    void note()
    {
        const std::lock_guard lock(mutex);
        known.clear();
        for (const auto& phone : connected)
            known.push_back(phone->what());
        phoneCount = known.size();
    }

    template <typename Keep>
    void tell(Text text, Keep keep)
    {
        asio::post(context,
                   [this, text = std::move(text), keep]
                   {
                       keep(text);
                       for (const auto& phone : connected)
                           if (phone->isOpen())
                               phone->send(text);
                   });
    }

    asio::io_context context{1};
    Tcp::acceptor acceptor;
    asio::steady_timer pause; ///< before the next try to let somebody in
    std::string address;
    std::uint16_t port = 0;
    mutable std::mutex mutex;
    std::string code;                  ///< guarded by the mutex
    std::vector<ConnectedPhone> known; ///< likewise
    std::atomic<std::size_t> phoneCount{0};
    std::array<std::atomic<std::size_t>, 3> refusals{}; ///< by their reasons
    // Of the thread.
    std::deque<std::string> cookies, usedCodes;
    std::size_t codeNumber = 0; ///< of codes before this one
    std::vector<std::shared_ptr<Phone>> connected;
    Film shown;
    Text clipText, playText; ///< for phones that come later
    std::thread thread;
};
} // namespace

std::string phonesText(const std::vector<ConnectedPhone>& phones)
{
    std::string text = fmt::format("{} phone{} connected", phones.size(), phones.size() == 1 ? "" : "s");
    std::vector<ConnectedPhone> told;
    for (const ConnectedPhone& phone : phones)
    {
        if (std::find(told.begin(), told.end(), phone) != told.end())
            continue;
        const auto count = std::count(phones.begin(), phones.end(), phone);
        const bool isOne = count == 1;
        const char* what = phone.state == PhoneState::cannotVibrate ? "cannot vibrate"
                           : phone.state == PhoneState::feels       ? isOne ? "feels" : "feel"
                           : isOne                                  ? "waits for a touch of its button"
                                                                    : "wait for a touch of their buttons";
        text += fmt::format("{} {} {} {}", told.empty() ? ":" : ",", count, phone.kind, what);
        told.push_back(phone);
    }
    return text;
}

std::string refusalText(Refusal refusal)
{
    switch (refusal)
    {
    case Refusal::usedCode:
        return "this code let another phone in; scan the code that is shown now";
    case Refusal::wrongCode:
        return "this code is not one of this session; scan the code that is shown now";
    case Refusal::full:
        break;
    }
    return fmt::format("{} phones are connected already, which is all that can be", mostPhones);
}

Result<std::unique_ptr<PhoneServer>> PhoneServer::start(const PhoneServerParams& params)
{
    auto server = std::make_unique<Server>();
    if (auto listening = server->listen(params); !listening)
        return listening.error();
    return std::unique_ptr<PhoneServer>(std::move(server));
}

} // namespace pacini::phone
