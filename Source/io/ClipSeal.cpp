#include "io/ClipSeal.h"

#include "io/Fingerprint.h"
#include "io/formats/json/ClipFields.h"

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace pacini
{

namespace
{
bool isSeal(const EncoderParameter& parameter)
{
    return parameter.name == clipSealName;
}

/// Takes in the fields of a clip one after another, lists and texts with their length. The names of the fields and the
/// format do not count: a clip is the same in every form.
class ClipFingerprint
{
public:
    void format(const DocumentFormat&) {}

    void number(std::string_view, double value, Need need)
    {
        if (need == Need::optional && value == 0.0) // came later, and seals stay
            return;
        value += 0.0; // no two zeros
        all.add(std::as_bytes(std::span(&value, 1)));
    }
    void integer(std::string_view name, std::integral auto value)
    {
        number(name, static_cast<double>(value), Need::required);
    }
    void text(std::string_view name, std::string_view value, Need = Need::required)
    {
        integer(name, value.size());
        all.add(value);
    }

    template <typename T, typename Fields>
    void object(std::string_view, const T& value, Need, Fields fields)
    {
        fields(value, *this);
    }

    template <typename T, typename Fields>
    void list(std::string_view name, const std::vector<T>& values, std::size_t, std::string_view, Fields fields, Need)
    {
        if (name != "markers") // they came first without, and seals stay
            integer(name, values.size());
        for (const T& value : values)
            fields(value, *this);
    }
    template <typename T, typename Fields>
    void timeline(std::string_view name, const std::vector<T>& values, Need need, Fields fields)
    {
        list(name, values, 0, "", fields, need);
    }

    void parameters(std::string_view, const std::vector<EncoderParameter>& values)
    {
        for (const auto& [name, value] : values)
        {
            if (name == clipSealName)
                continue;
            text("", name);
            if (const auto* words = std::get_if<std::string>(&value))
                text("", *words);
            else if (const auto* truth = std::get_if<bool>(&value))
                integer("", int(*truth));
            else
                number("", std::get<double>(value), Need::usual);
        }
    }

    [[nodiscard]] std::uint64_t value() const { return all.value(); }

private:
    Fingerprint all;
};

/// Of everything but the seal; a number, whose digits pack better than letters.
double checksum(const Clip& clip)
{
    ClipFingerprint all;
    clipFields::document(clip, all);
    return static_cast<double>(static_cast<std::uint32_t>(all.value() ^ (all.value() >> 32)));
}
} // namespace

void sealClip(Clip& clip)
{
    const double sum = checksum(clip);
    std::erase_if(clip.encoder, isSeal);
    clip.encoder.push_back({clipSealName, sum});
}

ClipSeal sealOf(const Clip& clip)
{
    const auto seal = std::find_if(clip.encoder.begin(), clip.encoder.end(), isSeal);
    if (seal == clip.encoder.end())
        return ClipSeal::missing;
    const auto* sum = std::get_if<double>(&seal->value);
    return sum != nullptr && *sum == checksum(clip) ? ClipSeal::whole : ClipSeal::broken;
}

} // namespace pacini
