#!/usr/bin/env bash
# Makes the installer for macOS of what the workflow build.yml joins for both machines: bin, lib and plugins.
#
#   bash cmake/make_macos_package.sh FOLDER PACKAGE.pkg
#
# Signs if PACINI_SIGN_WITH names a "Developer ID Application" and PACINI_SIGN_PACKAGE_WITH a "Developer ID Installer" of the
# keychain, and has Apple notarise it if PACINI_NOTARY_PROFILE names what `xcrun notarytool store-credentials` has stored.
# Without these the package is not signed, and macOS asks before it installs it. Nobody has run this on macOS: its steps are
# those of Apple's "Notarizing macOS software before distribution" and of the manuals of pkgbuild(1) and productbuild(1).
set -euo pipefail

fail() { printf 'make_macos_package: %s\n' "$*" >&2; exit 1; }

[ $# = 2 ] || fail "needs the folder of the programs and the package to make"
programs=$1 package=$2
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
[ -d "$programs" ] || fail "$programs: is no folder"
[ ! -e "$package" ] || fail "$package: exists; remove it first"
for tool in pkgbuild productbuild plutil; do
    command -v "$tool" >/dev/null || fail "$tool is missing: this runs on macOS with Xcode's command line tools"
done
if [ -n "${PACINI_NOTARY_PROFILE:-}" ] && [ -z "${PACINI_SIGN_WITH:-}" -o -z "${PACINI_SIGN_PACKAGE_WITH:-}" ]; then
    fail "Apple notarises only what is signed: set PACINI_SIGN_WITH and PACINI_SIGN_PACKAGE_WITH too"
fi
version=$(sed -nE 's/^project\(Pacini VERSION ([0-9.]+) .*/\1/p' "$source/CMakeLists.txt")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/parts"

# Where each part goes, and what it is called in the installer.
parts=(
    "vst3|VST3|/Library/Audio/Plug-Ins/VST3|plugins/VST3/Pacini.vst3"
    "au|Audio Unit|/Library/Audio/Plug-Ins/Components|plugins/AU/Pacini.component"
    "clap|CLAP|/Library/Audio/Plug-Ins/CLAP|plugins/CLAP/Pacini.clap"
    "lv2|LV2|/Library/Audio/Plug-Ins/LV2|plugins/LV2/Pacini.lv2"
    "standalone|Standalone program|/Applications|plugins/Standalone/Pacini.app"
    "editor|Clip editor|/Applications|plugins/Standalone/PaciniEditor.app"
    "command|Command and library|/usr/local|bin lib"
)

# Inside out: a signature of a bundle covers what is in it. The hardened runtime is what Apple notarises; with it, programs
# that listen need the right to the sound input.
sign() {
    [ -n "${PACINI_SIGN_WITH:-}" ] || return 0
    local rights=()
    [[ "$1" != *.app ]] || rights=(--entitlements "$work/rights.plist")
    codesign --force --options runtime --timestamp ${rights[@]+"${rights[@]}"} --sign "$PACINI_SIGN_WITH" "$1"
}
cat >"$work/rights.plist" <<'XML'
<?xml version="1.0" encoding="UTF-8"?>
<!DOCTYPE plist PUBLIC "-//Apple//DTD PLIST 1.0//EN" "http://www.apple.com/DTDs/PropertyList-1.0.dtd">
<plist version="1.0">
<dict>
    <key>com.apple.security.device.audio-input</key>
    <true/>
</dict>
</plist>
XML

choices="" lines="" references=""
for part in "${parts[@]}"; do
    IFS='|' read -r name title place files <<<"$part"
    root="$work/$name"
    mkdir "$root"
    for file in $files; do
        [ -e "$programs/$file" ] || fail "$programs/$file: is missing"
        cp -R "$programs/$file" "$root"
    done
    while IFS= read -r library; do
        sign "$library"
    done < <(find "$root" -type f \( -name '*.dylib' -o -name '*.so' -o -perm -u+x \) ! -path '*/Contents/MacOS/*' | sort)
    for file in $files; do
        [[ "$file" != plugins/* || "$file" == *.lv2 ]] || sign "$root/$(basename "$file")"
    done
    # Else the installer would write to where somebody has moved his copy.
    pkgbuild --analyze --root "$root" "$work/$name.plist"
    for ((bundle = 0; ; ++bundle)); do
        plutil -replace "$bundle.BundleIsRelocatable" -bool NO "$work/$name.plist" 2>/dev/null || break
    done
    pkgbuild --root "$root" --component-plist "$work/$name.plist" --install-location "$place" \
        --identifier "org.pacini.$name" --version "$version" "$work/parts/$name.pkg"
    lines+="        <line choice=\"$name\"/>"$'\n'
    choices+="    <choice id=\"$name\" title=\"$title\"><pkg-ref id=\"org.pacini.$name\"/></choice>"$'\n'
    references+="    <pkg-ref id=\"org.pacini.$name\" version=\"$version\">$name.pkg</pkg-ref>"$'\n'
done

mkdir "$work/texts"
cp "$source/LICENSE" "$work/texts/LICENSE.txt"
cat >"$work/distribution.xml" <<XML
<?xml version="1.0" encoding="utf-8"?>
<installer-gui-script minSpecVersion="2">
    <title>Pacini $version</title>
    <license file="LICENSE.txt"/>
    <options customize="always" require-scripts="false" hostArchitectures="arm64,x86_64"/>
    <volume-check><allowed-os-versions><os-version min="13.3"/></allowed-os-versions></volume-check>
    <choices-outline>
${lines%$'\n'}
    </choices-outline>
${choices}${references%$'\n'}
</installer-gui-script>
XML
signing=()
[ -z "${PACINI_SIGN_PACKAGE_WITH:-}" ] || signing=(--sign "$PACINI_SIGN_PACKAGE_WITH" --timestamp)
made="$work/$(basename "$package")"
productbuild --distribution "$work/distribution.xml" --package-path "$work/parts" --resources "$work/texts" \
    ${signing[@]+"${signing[@]}"} "$made"
if [ -n "${PACINI_NOTARY_PROFILE:-}" ]; then
    xcrun notarytool submit "$made" --keychain-profile "$PACINI_NOTARY_PROFILE" --wait
    xcrun stapler staple "$made"
    spctl --assess --type install --verbose "$made"
fi
mv "$made" "$package"
printf '%s\n' "$package"
