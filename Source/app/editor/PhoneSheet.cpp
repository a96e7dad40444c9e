// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/editor/PhoneSheet.h"

#include "editor/Controls.h"
#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"

#include <utility>

namespace pacini::app
{

namespace
{
constexpr int gap = 8;
constexpr int glanceInterval = 250; // ms
constexpr int noticeTime = 10000;   // ms
constexpr int quietZone = 4;        // modules that are light around the picture
} // namespace

PhoneSheet::PhoneSheet(PhoneOutput& wanted) : Sheet("Feel on a phone", 640, 420), output(wanted)
{
    const auto explanation =
        editor::tr("Scan the QR code with a phone in the same network; it vibrates along with the editor. Each code "
                   "works once and is then replaced. Browsers on Android vibrate, those on iPhones and Firefox do not. "
                   "The connection is not encrypted.");
    help.setMultiLine(true);
    help.setReadOnly(true);
    help.setCaretVisible(false);
    help.setWantsKeyboardFocus(false);
    for (const int colour : {juce::TextEditor::backgroundColourId, juce::TextEditor::outlineColourId,
                             juce::TextEditor::focusedOutlineColourId})
        help.setColour(colour, juce::Colours::transparentBlack);
    help.setFont(editor::usualFont());
    help.setText(explanation, juce::dontSendNotification);
    setDescription(explanation);
    status.setFont(editor::usualFont());
    address.setReadOnly(true);
    address.setMultiLine(true);
    address.setTitle("Address for the phone");
    address.setFont(editor::usualFont());
    for (juce::Component* part : std::initializer_list<juce::Component*>{&help, &address, &status})
        addAndMakeVisible(part);
    endButton.setButtonText("End the session");
    editor::prepareButton(endButton, "Disconnects all phones and closes their pages",
                          [this]
                          {
                              output.end();
                              close();
                          });
    addAndMakeVisible(endButton);
    setAnswers({{"Close", {}}});
    if (const auto* server = output.server())
        for (auto& [reason, count] : refusals)
            count = server->refused(reason); // before it was opened
    refresh();
    startTimer(glanceInterval);
}

void PhoneSheet::timerCallback()
{
    refresh();
}

juce::String PhoneSheet::newRefusal(const phone::PhoneServer& server)
{
    using phone::Refusal;
    juce::String text;
    for (auto& [reason, count] : refusals)
        if (const std::size_t now = server.refused(reason); now != std::exchange(count, now))
            text = reason == Refusal::usedCode ? editor::tr("A phone was refused: its code was already used.")
                   : reason == Refusal::wrongCode
                       ? editor::tr("A phone was refused: its code is not from this session.")
                       : editor::tr("A phone was refused: {0} are connected already.",
                                    {juce::String(static_cast<int>(phone::mostPhones))});
    return text;
}

void PhoneSheet::refresh()
{
    const auto* server = output.server();
    if (server == nullptr)
        return;
    if (const std::string url = server->url(); url != shown)
    {
        shown = url;
        modules = phone::qrModules(url);
        address.setText(editor::toText(url), juce::dontSendNotification);
        repaint();
    }
    const auto phones = static_cast<int>(server->phones());
    if (const juce::String refusal = newRefusal(*server); refusal.isNotEmpty())
    {
        notice = refusal;
        noticeGlances = noticeTime / glanceInterval;
    }
    else if (noticeGlances > 0)
        --noticeGlances;
    const juce::String text = noticeGlances > 0 ? notice
                              : phones == 0     ? editor::tr("No phone is connected.")
                              : phones == 1     ? editor::tr("One phone is connected.")
                                                : editor::tr("{0} phones are connected.", {juce::String(phones)});
    if (status.getText() != text)
    {
        status.setText(text, juce::dontSendNotification);
        juce::AccessibilityHandler::postAnnouncement(text, juce::AccessibilityHandler::AnnouncementPriority::medium);
    }
}

void PhoneSheet::layOut(juce::Rectangle<int> area)
{
    picture = area.removeFromLeft(juce::jmin(area.getHeight(), area.getWidth() / 2))
                  .withSizeKeepingCentre(juce::jmin(area.getHeight(), area.getWidth()),
                                         juce::jmin(area.getHeight(), area.getWidth()));
    area.removeFromLeft(2 * gap);
    endButton.setBounds(area.removeFromBottom(4 * gap).removeFromRight(20 * gap));
    area.removeFromBottom(gap);
    status.setBounds(area.removeFromBottom(5 * gap));
    address.setBounds(area.removeFromBottom(6 * gap));
    help.setBounds(area);
    help.applyColourToAllText(editor::paletteFor(*this).text);
}

void PhoneSheet::paintOverChildren(juce::Graphics& g)
{
    // Black on white whatever the look: cameras want it so.
    const auto size = static_cast<int>(modules.size());
    if (size == 0)
        return;
    const int pixels = juce::jmax(1, picture.getWidth() / (size + 2 * quietZone));
    const auto square = picture.withSizeKeepingCentre(pixels * (size + 2 * quietZone), pixels * (size + 2 * quietZone));
    g.setColour(juce::Colours::white);
    g.fillRect(square);
    g.setColour(juce::Colours::black);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            if (modules[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)])
                g.fillRect(square.getX() + pixels * (x + quietZone), square.getY() + pixels * (y + quietZone), pixels,
                           pixels);
}

} // namespace pacini::app
