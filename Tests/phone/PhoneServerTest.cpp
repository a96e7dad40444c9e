#include "phone/PhoneServer.h"

#include "phone/QrText.h"
#include "support/Catch.h"
#include "support/ClipSamples.h"

#ifndef _WIN32

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <utility>
#include <vector>

using namespace pacini;
using phone::PhoneServer;

namespace
{
/// A connection to the server on this machine.
class Caller
{
public:
    /// From 127.0.0.`from`: another one than 1 is another machine for the server.
    explicit Caller(const std::string& url, unsigned from = 1) : place(url.substr(7, url.find("/?") - 7))
    {
        sockaddr_in to{};
        to.sin_family = AF_INET;
        to.sin_port = htons(static_cast<std::uint16_t>(std::stoi(place.substr(place.find(':') + 1))));
        to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        handle = socket(AF_INET, SOCK_STREAM, 0);
        sockaddr_in own{};
        own.sin_family = AF_INET;
        own.sin_addr.s_addr = htonl(INADDR_LOOPBACK - 1 + from);
        bind(handle, reinterpret_cast<const sockaddr*>(&own), sizeof own);
        isThere = connect(handle, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0;
        const timeval patience{10, 0};
        setsockopt(handle, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    }
    ~Caller() { close(handle); }
    Caller(const Caller&) = delete;
    Caller& operator=(const Caller&) = delete;

    /// What the server answers until `end`, or until it closes.
    std::string ask(const std::string& method, const std::string& target, const std::string& more = "",
                    const std::string& end = "")
    {
        const std::string text = method + " " + target + " HTTP/1.1\r\nHost: " + place + "\r\n" + more + "\r\n";
        send(handle, text.data(), text.size(), MSG_NOSIGNAL);
        return hear(end);
    }

    /// What comes until `end`, or until the server closes. What came with it is for the next call.
    std::string hear(const std::string& end)
    {
        std::string heard = std::exchange(later, "");
        char buffer[4096];
        while (end.empty() || heard.find(end) == std::string::npos)
        {
            const auto count = recv(handle, buffer, sizeof buffer, 0);
            if (count <= 0)
                break;
            heard.append(buffer, static_cast<std::size_t>(count));
        }
        if (const auto at = heard.find(end); !end.empty() && at != std::string::npos)
        {
            later = heard.substr(at + end.size());
            heard.resize(at + end.size());
        }
        return heard;
    }

    std::string place;
    bool isThere = false;

private:
    int handle = -1;
    std::string later;
};

std::unique_ptr<PhoneServer> server()
{
    phone::PhoneServerParams params;
    params.address = "127.0.0.1";
    auto started = PhoneServer::start(params);
    REQUIRE(started.ok());
    return std::move(*started);
}

std::string codeOf(const std::string& url)
{
    return url.substr(url.find("/?"));
}

/// The cookie that a tap on the page brings; empty when it is refused.
std::string pair(const std::string& url)
{
    const std::string answer = Caller(url).ask("POST", codeOf(url), "Content-Length: 0\r\n");
    const auto at = answer.find("Set-Cookie: ");
    return at == std::string::npos ? "" : answer.substr(at + 12, answer.find(';', at) - at - 12);
}

/// Asks for the events of the server, as a browser does.
std::string upgrade(Caller& caller, const std::string& cookie)
{
    return caller.ask("GET", "/events",
                      "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                      "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nOrigin: http://" +
                          caller.place + "\r\nCookie: " + cookie + "\r\n",
                      "\r\n\r\n");
}
} // namespace

TEST_CASE("A paired browser on this machine gets a picture of the next code, and nobody else does", "[phone]")
{
    const auto host = server();
    const auto picture = [&](const std::string& cookie, unsigned from = 1)
    {
        return Caller(host->url(), from).ask("GET", "/code.svg?1", cookie.empty() ? "" : "Cookie: " + cookie + "\r\n");
    };
    CHECK(picture("").find(" 403 ") != std::string::npos);
    CHECK(picture("pacini=22222222222222222222222222222222").find(" 403 ") != std::string::npos);
    const std::string cookie = pair(host->url());
    CHECK(picture(cookie, 2).find(" 404 ") != std::string::npos);
    const std::string first = picture(cookie);
    if (phone::qrModules("").empty())
    {
        CHECK(first.find(" 404 ") != std::string::npos);
        return;
    }
    CHECK(first.find("image/svg+xml") != std::string::npos);
    CHECK(first.find(phone::qrSvg(phone::qrModules(host->url()))) != std::string::npos);
    Caller here(host->url()), elsewhere(host->url(), 2);
    CHECK(upgrade(here, cookie).find(" 101 ") != std::string::npos);
    CHECK(upgrade(elsewhere, cookie).find(" 101 ") != std::string::npos);
    CHECK(here.hear(R"({"kind":"code","number":1})").find(R"({"kind":"code","number":1})") != std::string::npos);
    CHECK_FALSE(pair(host->url()).empty());
    CHECK(here.hear(R"("number":2})").find(R"({"kind":"code","number":2})") != std::string::npos);
    CHECK(picture(cookie) != first);
    host->stop();
    CHECK(elsewhere.hear(R"("stop"})").find("code") == std::string::npos);
}

TEST_CASE("Thirty phones pair in turn, and looking at the address uses no code up", "[phone]")
{
    const auto host = server();
    for (int i = 0; i < 30; ++i)
    {
        const std::string url = host->url();
        CHECK(Caller(url).ask("GET", codeOf(url)).find("200 OK") != std::string::npos);
        CHECK(host->url() == url);
        CHECK_FALSE(pair(url).empty());
        CHECK(host->url() != url);
    }
    CHECK(host->refused(phone::Refusal::usedCode) == 0);
    CHECK(host->refused(phone::Refusal::full) == 0);
}

TEST_CASE("A code that was used is told from one that never was", "[phone]")
{
    const auto host = server();
    const std::string url = host->url();
    REQUIRE_FALSE(pair(url).empty());
    CHECK(pair(url).empty());
    CHECK(host->refused(phone::Refusal::usedCode) == 1);
    CHECK(pair(url.substr(0, url.find("code=") + 5) + "never").empty());
    CHECK(host->refused(phone::Refusal::wrongCode) == 1);
    CHECK(Caller(url).ask("GET", "/", "").find("403") != std::string::npos);
    CHECK(phone::refusalText(phone::Refusal::usedCode) != phone::refusalText(phone::Refusal::wrongCode));
}

TEST_CASE("Phones come and go while clips are shown, played and stopped", "[phone]")
{
    const auto host = server();
    std::atomic<int> told = 0;
    std::vector<std::string> cookies;
    for (int i = 0; i < 4; ++i)
        cookies.push_back(pair(host->url()));
    std::vector<std::thread> people;
    for (const std::string& cookie : cookies)
        people.emplace_back(
            [&, cookie]
            {
                for (int visit = 0; visit < 5; ++visit)
                {
                    Caller phone(host->url());
                    if (upgrade(phone, cookie).find("101 ") != std::string::npos &&
                        phone.hear("\"clip\"").find("\"clip\"") != std::string::npos)
                        ++told;
                }
            });
    const Clip clip = test::randomClip(1);
    for (int i = 0; i < 200 && told < 20; ++i)
    {
        host->show(clip);
        host->play(Seconds(0.1));
        (void)host->phones();
        (void)host->url();
        host->stop();
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    for (std::thread& person : people)
        person.join();
    CHECK(told == 20);
}

TEST_CASE("A server ends while phones are connected", "[phone]")
{
    auto host = server();
    const std::string url = host->url();
    const std::string cookie = pair(url);
    Caller phone(url);
    REQUIRE(upgrade(phone, cookie).find("101 ") != std::string::npos);
    host.reset();
    phone.hear("");
    CHECK_FALSE(Caller(url).isThere);
}

#endif
