import type { ProfileInput } from './index.js'

/** A node that turns sound into the drive signal of an actuator, one channel, `latency` frames late. */
export function createTranslator(
  context: BaseAudioContext,
  options?: { profile?: ProfileInput }
): Promise<AudioWorkletNode & { readonly latency: number }>
