#pragma once

// Streaming reader of JSON documents by lists of fields: fills a value as the text comes, however long it is.

#include "io/Fields.h"
#include "io/FormatNames.h"
#include "io/JsonText.h"

#include <pacini/clip/Clip.h>
#include <pacini/foundation/Result.h>

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <unordered_set>
#include <utility>
#include <variant>
#include <vector>

namespace pacini
{

/// A value without parts; monostate is null. A text may be moved from.
using JsonScalar = std::variant<std::monostate, double, bool, std::string*>;

/// Whether an entry took a scalar, and if not, whether its kind or its value is wrong.
enum class Taken
{
    yes,
    wrongKind,
    wrongValue,
    noName ///< an empty file name
};

/// Takes a scalar that is a T.
template <typename T, typename Target>
[[nodiscard]] bool takeAs(JsonScalar& scalar, Target& target)
{
    if constexpr (std::is_same_v<T, std::string>)
    {
        if (auto* const* text = std::get_if<std::string*>(&scalar))
            return target = std::move(**text), true;
    }
    else if (const T* value = std::get_if<T>(&scalar))
        return target = *value, true;
    return false;
}

/// Takes a scalar that is one of these types.
template <typename... T>
inline constexpr auto takeAny = [](auto& target, JsonScalar& scalar)
{
    return (takeAs<T>(scalar, target) || ...) ? Taken::yes : Taken::wrongKind;
};

/// Takes a number without fraction in a range.
template <typename Integer>
[[nodiscard]] Taken takeWhole(JsonScalar& scalar, double lowest, double highest, Integer& value)
{
    const double* number = std::get_if<double>(&scalar);
    if (number == nullptr)
        return Taken::wrongKind;
    if (!(*number >= lowest && *number <= highest && std::trunc(*number) == *number))
        return Taken::wrongValue;
    value = static_cast<Integer>(*number);
    return Taken::yes;
}

/// The numbers that an entry without fractions may have.
struct WholeRange
{
    double lowest;
    double highest;
    std::string_view needed;
    std::string_view kind = needed; ///< what is needed when it is no number at all
};

inline constexpr WholeRange anyInt{std::numeric_limits<int>::min(), std::numeric_limits<int>::max(),
                                   "a whole number of at most 10 digits", "a whole number"};

/// Fills a list of fields from the events of a document. For each key the handler searches the list for the field of
/// that name, which receives the value; lists of fields must therefore be functions without state.
class FieldsHandler final : public JsonHandler
{
public:
    static constexpr bool reads = true;

    /// Reads into `document` by `fields`.
    template <typename T, typename Fields>
    FieldsHandler(T& document, Fields)
    {
        static constexpr Kind kind{.open = itself, .visit = visitorOf<T, Fields>};
        entry = {.kind = &kind, .target = &document, .needed = anObject};
    }

    /// The keys that a T may have.
    template <typename T, typename Fields>
    [[nodiscard]] static std::vector<std::string_view> keysOf(Fields fields)
    {
        T value;
        FieldsHandler handler(value, fields);
        return handler.keys(&value, visitorOf<T, Fields>);
    }

    // What fields may be.

    void number(std::string_view name, double& value, Need need)
    {
        scalar(name, value, need, "a number", takeAny<double>);
    }

    void text(std::string_view name, std::string& value, Need need = Need::required)
    {
        scalar(name, value, need, "a text in quotes", takeAny<std::string>);
    }

    template <typename Integer>
    void integer(std::string_view name, Integer& value, const WholeRange& range = anyInt)
    {
        static constexpr Kind kind{.set = setWhole<Integer>};
        if (asks(name, Need::usual))
            entry = {.kind = &kind, .target = &value, .needed = range.kind, .detail = &range};
    }

    template <typename E, std::size_t Count>
    void choice(std::string_view name, E& value, const std::array<Choice<E>, Count>& choices, Need need)
    {
        static constexpr Kind kind{.set = setChoice<E, Count>, .describe = namesOf<E, Count>};
        if (asks(name, need))
            entry = {.kind = &kind, .target = &value, .detail = &choices};
    }

    /// What `take(value, scalar)` makes of any scalar.
    template <typename T, typename Take>
    void scalar(std::string_view name, T& value, Need need, std::string_view needed, Take)
    {
        static constexpr Kind kind{.set = setter<T, Take>()};
        if (asks(name, need))
            entry = {.kind = &kind, .target = &value, .needed = needed};
    }

    /// With `take` the object may also be a scalar.
    template <typename T, typename Fields, typename Take = std::nullptr_t>
    void object(std::string_view name, T& value, Need need, Fields, std::string_view needed = anObject, Take = {})
    {
        static constexpr Kind kind{.set = setter<T, Take>(), .open = itself, .visit = visitorOf<T, Fields>};
        if (asks(name, need))
            entry = {.kind = &kind, .target = &value, .needed = needed};
    }

    template <typename T, typename Fields>
    void optionalObject(std::string_view name, std::optional<T>& value, Fields, std::string_view needed = anObject)
    {
        static constexpr Kind kind{.open = emplaceIn<T>, .visit = visitorOf<T, Fields>};
        if (asks(name, Need::optional))
            entry = {.kind = &kind, .target = &value, .needed = needed};
    }

    /// At most `most` objects, called `elements` in errors ("bands that a clip may have"). With `take` they may also be
    /// scalars.
    template <typename T, typename Fields, typename Take = std::nullptr_t>
    void list(std::string_view name, std::vector<T>& values, std::size_t most, std::string_view elements, Fields,
              Need need, std::string_view needed = anObject, Take = {})
    {
        static constexpr Kind kind{
            .set = appender<T, Take>(), .open = appendTo<T>, .visit = visitorOf<T, Fields>, .isList = true};
        if (asks(name, need))
            entry = {&kind, &values, needed, nullptr, most, elements};
    }

    /// A list of numbers, which must be there.
    template <typename Number>
    void numbers(std::string_view name, std::vector<Number>& values, std::size_t most)
    {
        static constexpr Kind kind{.set = appender<Number, decltype(takeAny<Number>)>(), .isList = true};
        if (asks(name, Need::required))
            entry = {&kind, &values, "a number", nullptr, most, "numbers that it may have"};
    }

    template <typename T, typename Fields>
    void timeline(std::string_view name, std::vector<T>& values, Need need, Fields fields)
    {
        list(name, values, SIZE_MAX, "", fields, need);
    }

    template <typename T, typename Fields>
    void rows(std::string_view name, std::vector<T>& values, std::size_t most, std::string_view elements, Fields fields)
    {
        list(name, values, most, elements, fields, Need::usual);
    }

    /// An object whose names are free.
    void parameters(std::string_view name, std::vector<EncoderParameter>& values)
    {
        static constexpr Kind kind{.open = itself};
        if (!asks(name, Need::usual))
            return;
        entry = {.kind = &kind, .target = &values, .needed = anObject};
        parameterNames.clear();
    }

    void format(const DocumentFormat& document)
    {
        static constexpr Kind name{.set = checkName}, version{.set = checkVersion};
        if (asks("format", Need::required))
            entry = {.kind = &name, .needed = "a text in quotes", .detail = &document};
        if (asks("version", Need::required))
            entry = {.kind = &version, .needed = "a whole number", .detail = &document};
    }

    /// What must hold of an object when it is complete; the place of an error is below the object.
    template <typename Check>
    void check(Check whatHolds)
    {
        if (purpose == Purpose::find)
            requiredBits |= checks;
        if (purpose != Purpose::complete || !missing.empty())
            return;
        if (const Result<void> result = whatHolds(); !result)
            broken = result.error();
    }

    // The events.

    bool openObject() override
    {
        if (ignores())
            return ignoreContainer();
        const Entry& where = target();
        if (where.kind->open == nullptr || (where.kind->isList && !inList()))
            return wrongKind("an object");
        void* object = where.kind->open(where);
        if (object == nullptr)
            return full(where);
        levels.push_back({object, where.kind->visit});
        return true;
    }

    bool openList() override
    {
        if (ignores())
            return ignoreContainer();
        if (inList() || !entry.kind->isList)
            return wrongKind("a list");
        lists.push_back(entry);
        levels.push_back({nullptr, nullptr, true});
        return true;
    }

    bool close() override
    {
        if (ignored > 0)
        {
            --ignored;
            return true;
        }
        const Level& top = levels.back();
        if (top.isList)
            lists.pop_back();
        else if (top.visit != nullptr && (top.required == 0 || (top.required & ~top.seen) != 0))
        {
            missing = {};
            broken.reset();
            visit(Purpose::complete);
            if (!missing.empty())
                return stop(ErrorCode::invalidData, "is missing", fmt::format(".{}", missing));
            if (broken)
                return stop(broken->code, broken->message, broken->where);
        }
        levels.pop_back();
        return true;
    }

    bool key(std::string_view name) override
    {
        if (ignored > 0)
            return true;
        if (levels.back().visit == nullptr)
            return parameter(name);
        entry.kind = nullptr;
        wanted = name;
        requiredBits = foundBit = 0;
        visit(Purpose::find);
        Level& top = levels.back();
        if ((top.seen & foundBit) != 0)
            return twice();
        top.seen |= foundBit;
        top.required = requiredBits;
        if (entry.kind == nullptr)
            doubtKey(name, [this] { return keys(levels.back().object, levels.back().visit); });
        return true;
    }

    bool number(double value) override { return scalar(value); }
    bool text(std::string& value) override { return scalar(&value); }
    bool truth(bool value) override { return scalar(value); }
    /// Optional entries may be null.
    bool null() override { return (mayBeNull && !inList() && !ignores()) || scalar(std::monostate()); }

private:
    using Visit = void (*)(void*, FieldsHandler&);

    struct Entry;
    using Setter = bool (*)(FieldsHandler&, const Entry&, JsonScalar&);

    /// How entries of one type take what comes.
    struct Kind
    {
        Setter set = nullptr;                            ///< null: no scalars
        void* (*open)(const Entry&) = nullptr;           ///< the object that is filled next; null when the list is full
        Visit visit = nullptr;                           ///< the fields of objects; null: their names are free
        std::string (*describe)(const Entry&) = nullptr; ///< what is needed, where the entry does not say it
        bool isList = false;
    };

    /// Where the value of the last key goes, or the next element of a list.
    struct Entry
    {
        const Kind* kind = nullptr; ///< null: the key is not known
        void* target = nullptr;
        std::string_view needed = {};
        const void* detail = nullptr; ///< WholeRange, choices or DocumentFormat
        std::size_t most = SIZE_MAX;
        std::string_view elements = {};
    };

    struct Level
    {
        void* object;
        Visit visit;
        bool isList = false;
        std::uint64_t seen = 0;     ///< bit i: field i was given
        std::uint64_t required = 0; ///< bit i: it must be; 0: no key came yet, or none must
    };

    enum class Purpose
    {
        find,     ///< the field called `wanted`
        complete, ///< fields that were not given but must be
        list      ///< all names
    };

    static constexpr std::uint64_t checks = std::uint64_t(1) << 63; ///< is required, and no field: at most 63 fields
    static constexpr std::string_view anObject = "an object in braces";

    template <typename T, typename Fields>
    static void visitorOf(void* object, FieldsHandler& handler)
    {
        Fields{}(*static_cast<T*>(object), handler);
    }

    static void* itself(const Entry& where) { return where.target; }

    template <typename T>
    static void* emplaceIn(const Entry& where)
    {
        return &static_cast<std::optional<T>*>(where.target)->emplace();
    }

    template <typename T>
    static void* appendTo(const Entry& where)
    {
        auto& values = *static_cast<std::vector<T>*>(where.target);
        return values.size() < where.most ? &values.emplace_back() : nullptr;
    }

    /// Sets a T by what `Take` makes of a scalar; null without.
    template <typename T, typename Take>
    static constexpr Setter setter()
    {
        if constexpr (std::is_null_pointer_v<Take>)
            return nullptr;
        else
            return [](FieldsHandler& handler, const Entry& where, JsonScalar& value)
            {
                const Taken taken = Take{}(*static_cast<T*>(where.target), value);
                return taken == Taken::yes || handler.wrong(taken, value);
            };
    }

    /// The same of a new element of a list.
    template <typename T, typename Take>
    static constexpr Setter appender()
    {
        if constexpr (std::is_null_pointer_v<Take>)
            return nullptr;
        else
            return [](FieldsHandler& handler, const Entry& where, JsonScalar& value)
            {
                T element;
                if (const Taken taken = Take{}(element, value); taken != Taken::yes)
                    return handler.wrong(taken, value);
                void* place = appendTo<T>(where);
                if (place != nullptr)
                    *static_cast<T*>(place) = std::move(element);
                return place != nullptr || handler.full(where);
            };
    }

    template <typename Integer>
    static bool setWhole(FieldsHandler& handler, const Entry& where, JsonScalar& value)
    {
        const auto& range = *static_cast<const WholeRange*>(where.detail);
        const Taken taken = takeWhole(value, range.lowest, range.highest, *static_cast<Integer*>(where.target));
        return taken == Taken::yes ||
               handler.wrong(taken, value, taken == Taken::wrongValue ? range.needed : range.kind);
    }

    template <typename E, std::size_t Count>
    static bool setChoice(FieldsHandler& handler, const Entry& where, JsonScalar& value)
    {
        const auto& choices = *static_cast<const std::array<Choice<E>, Count>*>(where.detail);
        auto* const* text = std::get_if<std::string*>(&value);
        for (const auto& choice : choices)
            if (text != nullptr && **text == choice.name)
                return *static_cast<E*>(where.target) = choice.value, true;
        return handler.wrong(text != nullptr ? Taken::wrongValue : Taken::wrongKind, value);
    }

    template <typename E, std::size_t Count>
    static std::string namesOf(const Entry& where)
    {
        const auto& choices = *static_cast<const std::array<Choice<E>, Count>*>(where.detail);
        std::string all;
        for (const auto& choice : choices)
        {
            const char* joint = &choice == &choices.front() ? "" : &choice == &choices.back() ? " or " : ", ";
            all += fmt::format("{}\"{}\"", joint, choice.name);
        }
        return all;
    }

    static bool checkName(FieldsHandler& handler, const Entry& where, JsonScalar& value)
    {
        const auto& format = *static_cast<const DocumentFormat*>(where.detail);
        std::string given;
        if (!takeAs<std::string>(value, given))
            return handler.wrong(Taken::wrongKind, value);
        return given == format.name ||
               handler.stop(ErrorCode::invalidData, fmt::format("is \"{}\"; {} has \"{}\" here{}", shownText(given),
                                                                format.noun, format.name, detail::useOfFormat(given)));
    }

    static bool checkVersion(FieldsHandler& handler, const Entry& where, JsonScalar& value)
    {
        const auto& format = *static_cast<const DocumentFormat*>(where.detail);
        double given = 0.0;
        if (!takeAs<double>(value, given))
            return handler.wrong(Taken::wrongKind, value);
        if (given == format.version)
            return true;
        const std::string readable = fmt::format("; this program reads version {}", format.version);
        if (given > format.version && (std::trunc(given) == given || !format.whole))
            return handler.stop(ErrorCode::unsupportedVersion,
                                fmt::format("was written by a newer version ({}) of the format{}", given, readable));
        return handler.stop(ErrorCode::invalidData, fmt::format("is {}, which is not a version of the format{}", given,
                                                                format.whole ? readable : ""));
    }

    void visit(Purpose why)
    {
        purpose = why;
        field = 0;
        levels.back().visit(levels.back().object, *this);
    }

    std::vector<std::string_view> keys(void* object, Visit fields)
    {
        purpose = Purpose::list;
        names.clear();
        fields(object, *this);
        return std::exchange(names, {});
    }

    /// Whether the field that the list of fields is at is the one that was looked for.
    bool asks(std::string_view name, Need need)
    {
        const std::uint64_t bit = std::uint64_t(1) << field++;
        if (purpose == Purpose::find)
        {
            requiredBits |= need == Need::required ? bit : 0;
            foundBit |= name == wanted ? bit : 0;
            mayBeNull = name == wanted ? need != Need::required : mayBeNull;
            return name == wanted;
        }
        if (purpose == Purpose::list)
            names.push_back(name);
        else if (need == Need::required && (levels.back().seen & bit) == 0 && missing.empty())
            missing = name;
        return false;
    }

    bool parameter(std::string_view name)
    {
        using Value = decltype(EncoderParameter::value);
        static constexpr Kind kind{.set = setter<Value, decltype(takeAny<double, std::string, bool>)>()};
        if (!parameterNames.emplace(name).second)
            return twice();
        auto& values = *static_cast<std::vector<EncoderParameter>*>(levels.back().object);
        values.push_back({std::string(name), 0.0});
        mayBeNull = false;
        entry = {.kind = &kind, .target = &values.back().value, .needed = "a number, a text, true or false"};
        return true;
    }

    [[nodiscard]] bool inList() const { return !levels.empty() && levels.back().isList; }
    [[nodiscard]] const Entry& target() const { return inList() ? lists.back() : entry; }
    [[nodiscard]] bool ignores() const { return ignored > 0 || target().kind == nullptr; }

    bool ignoreContainer()
    {
        ++ignored;
        return true;
    }

    bool scalar(JsonScalar value)
    {
        if (ignores())
            return true;
        const Entry& where = target();
        return where.kind->set != nullptr && (inList() || !where.kind->isList) ? where.kind->set(*this, where, value)
                                                                               : wrong(Taken::wrongKind, value);
    }

    bool twice() { return stop(ErrorCode::invalidData, "is given twice; remove one of the two"); }

    bool full(const Entry& where)
    {
        return stop(ErrorCode::tooLarge, fmt::format("is beyond the {} {}", where.most, where.elements));
    }

    bool wrongKind(std::string_view found, std::string_view needed = {})
    {
        const Entry& where = target();
        std::string choices;
        if (needed.empty() && where.kind->describe != nullptr)
            needed = choices = where.kind->describe(where);
        else if (needed.empty())
            needed = where.kind->isList && !inList() ? "a list in brackets" : where.needed;
        return stop(ErrorCode::invalidData, fmt::format("is {}; {} is needed", found, needed));
    }

    /// Stops at a scalar that was not taken. `needed` is what would be, by itself what the entry says.
    bool wrong(Taken why, const JsonScalar& value, std::string_view needed = {})
    {
        static constexpr std::array<std::string_view, 4> kinds{"null", "a number", "true or false", "a text"};
        if (why == Taken::noName)
            return stop(ErrorCode::invalidData, "is empty; a file name is needed");
        if (why == Taken::wrongKind)
            return wrongKind(kinds[value.index()], needed);
        if (const double* number = std::get_if<double>(&value))
            return wrongKind(fmt::format("{}", *number), needed);
        return wrongKind(fmt::format("\"{}\"", shownText(*std::get<std::string*>(value))), needed);
    }

    std::vector<Level> levels;
    std::vector<Entry> lists; ///< those that are open
    Entry entry;
    std::size_t ignored = 0; ///< open objects and lists of unknown keys

    Purpose purpose = Purpose::find;
    std::uint32_t field = 0; ///< at which the list of fields is
    std::string_view wanted;
    std::uint64_t foundBit = 0, requiredBits = 0; ///< what Level::seen and ::required become
    bool mayBeNull = false;                       ///< the entry of the last key, which may be missing
    std::string_view missing;
    std::optional<Error> broken;
    std::vector<std::string_view> names;
    std::unordered_set<std::string> parameterNames;
};

} // namespace pacini
