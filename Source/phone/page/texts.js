// Texts of the phone's page in German and Japanese; English ones are their own keys.

const tables = {
  de: {
    'Pacini: feel on a phone': 'Pacini: auf einem Telefon fühlen',
    'Feel on a phone': 'Auf einem Telefon fühlen',
    'This phone will vibrate with what is played at the other end, until its page is closed.': 'Dieses Telefon vibriert mit dem, was am anderen Ende abgespielt wird, bis seine Seite geschlossen wird.',
    'Connect this phone': 'Dieses Telefon verbinden',
    'No clip yet.': 'Noch kein Clip.',
    'Feel what is played': 'Fühlen, was abgespielt wird',
    'Feel it now': 'Jetzt fühlen',
    'Connecting...': 'Verbinde...',
    'Code for the next phone': 'Code für das nächste Telefon',
    'Scan this code with a phone on the same network.': 'Diesen Code mit einem Telefon im selben Netz scannen.',
    'Connected, but this browser cannot vibrate: those of iPhones and Firefox cannot. Chrome on Android can.': 'Verbunden, aber dieser Browser kann nicht vibrieren: Die auf iPhones und Firefox können es nicht, Chrome auf Android kann es.',
    'Connected again. Feels what is played.': 'Wieder verbunden. Fühlt, was abgespielt wird.',
    'Connected. Touch the button once; browsers vibrate only then.': 'Verbunden. Die Taste einmal berühren; erst dann vibrieren Browser.',
    'The connection is lost. Trying again...': 'Die Verbindung ist verloren. Neuer Versuch...',
    'The session has ended, or the network is away. Trying again... Scan the new code for another session.': 'Die Sitzung ist beendet, oder das Netz ist weg. Neuer Versuch... Für eine andere Sitzung den neuen Code scannen.',
    '{0}, {1} s': '{0}, {1} s',
    'The first hour is felt.': 'Die erste Stunde wird gefühlt.',
    '{0} event is left out: it comes too soon after another for a phone.': '{0} Ereignis entfällt: Es folgt für ein Telefon zu schnell auf ein anderes.',
    '{0} events are left out: they come too soon after others for a phone.': '{0} Ereignisse entfallen: Sie folgen für ein Telefon zu schnell auf andere.',
    '{0} phones are connected already. Load this page again when one of them has left.': '{0} Telefone sind schon verbunden. Diese Seite neu laden, wenn eines davon gegangen ist.',
    'Feels what is played.': 'Fühlt, was abgespielt wird.',
    'Feels nothing until you touch the button again.': 'Fühlt nichts, bis die Taste wieder berührt wird.'
  },
  ja: {
    'Pacini: feel on a phone': 'Pacini：スマートフォンで感じる',
    'Feel on a phone': 'スマートフォンで感じる',
    'This phone will vibrate with what is played at the other end, until its page is closed.': 'このスマートフォンは、ページを閉じるまで、相手側の再生に合わせて振動します。',
    'Connect this phone': 'このスマートフォンを接続',
    'No clip yet.': 'クリップはまだありません。',
    'Feel what is played': '再生に合わせて感じる',
    'Feel it now': '今すぐ感じる',
    'Connecting...': '接続中...',
    'Code for the next phone': '次のスマートフォン用のコード',
    'Scan this code with a phone on the same network.': '同じネットワークのスマートフォンでこのコードを読み取ってください。',
    'Connected, but this browser cannot vibrate: those of iPhones and Firefox cannot. Chrome on Android can.': '接続しましたが、このブラウザーは振動できません：iPhoneのブラウザーとFirefoxはできません。AndroidのChromeはできます。',
    'Connected again. Feels what is played.': '再接続しました。再生に合わせて振動します。',
    'Connected. Touch the button once; browsers vibrate only then.': '接続しました。ボタンに一度触れてください。ブラウザーはその後で振動できます。',
    'The connection is lost. Trying again...': '接続が切れました。再試行中...',
    'The session has ended, or the network is away. Trying again... Scan the new code for another session.': 'セッションが終了したか、ネットワークに接続できません。再試行中... 別のセッションでは新しいコードを読み取ってください。',
    '{0}, {1} s': '{0}、{1} 秒',
    'The first hour is felt.': '最初の1時間を感じられます。',
    '{0} event is left out: it comes too soon after another for a phone.': 'イベント{0}個を省略：スマートフォンには間隔が短すぎます。',
    '{0} events are left out: they come too soon after others for a phone.': 'イベント{0}個を省略：スマートフォンには間隔が短すぎます。',
    '{0} phones are connected already. Load this page again when one of them has left.': 'すでに{0}台が接続しています。1台が離れたら、このページを再読み込みしてください。',
    'Feels what is played.': '再生に合わせて振動します。',
    'Feels nothing until you touch the button again.': 'もう一度ボタンに触れるまで振動しません。'
  }
}
const language = navigator.languages.map((code) => code.slice(0, 2)).find((code) => code === 'en' || tables[code]) ?? 'en'
const table = tables[language] ?? {}
document.documentElement.lang = language

/** A text in the language of the browser, with `{0}`, `{1}`... replaced by values. */
export const t = (english, ...values) => (table[english] ?? english).replace(/\{(\d)\}/g, (_, which) => values[which])

/** A number with two decimals, as the language writes it. */
export const seconds = (value) => value.toLocaleString(language, { minimumFractionDigits: 2, maximumFractionDigits: 2, useGrouping: false })

/** Puts the markup into the language. */
export const translate = () => {
  document.title = t(document.title)
  for (const element of document.querySelectorAll('h1, p, button, figcaption')) element.textContent = t(element.textContent)
  for (const image of document.querySelectorAll('img')) image.alt = t(image.alt)
}
