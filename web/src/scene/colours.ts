// Colours of numbers: maps that are even in lightness and read by colour-blind people.

/** Viridis (for amounts), at nine even steps. */
const VIRIDIS = ['#440154', '#472d7b', '#3b528b', '#2c728e', '#21918c', '#28ae80', '#5ec962', '#addc30', '#fde725'];
/** Cividis (for maps of the workspace), at nine even steps. */
const CIVIDIS = ['#00224e', '#123570', '#3b496c', '#575d6d', '#707173', '#8a8678', '#a59c74', '#c3b369', '#fee838'];
/** Blue to orange through grey (for numbers with a sign), at nine even steps. */
const SIGNED = ['#2166ac', '#4393c3', '#92c5de', '#c8dde8', '#dedede', '#f6d3b3', '#f4a65c', '#d9720f', '#a34700'];

export type Ramp = 'amount' | 'map' | 'signed';
export type Rgb = [number, number, number];

const RAMPS: Record<Ramp, Rgb[]> = {
  amount: VIRIDIS.map(parse),
  map: CIVIDIS.map(parse),
  signed: SIGNED.map(parse),
};

function parse(hex: string): Rgb {
  const value = Number.parseInt(hex.slice(1), 16);
  return [(value >> 16) / 255, ((value >> 8) & 255) / 255, (value & 255) / 255];
}

/** Writes the colour of `t` (0 to 1) as sRGB numbers from 0 to 1 into `into` at `at`. */
export function colour(ramp: Ramp, t: number, into: { [at: number]: number }, at: number): void {
  const steps = RAMPS[ramp];
  const place = Math.min(Math.max(Number.isFinite(t) ? t : 0, 0), 1) * (steps.length - 1);
  const below = Math.min(Math.floor(place), steps.length - 2);
  const [from, to] = [steps[below] as Rgb, steps[below + 1] as Rgb];
  for (let k = 0; k < 3; k++) {
    into[at + k] = (from[k] as number) + (place - below) * ((to[k] as number) - (from[k] as number));
  }
}

/** The colour of `t` as CSS. */
export function css(ramp: Ramp, t: number): string {
  const rgb: Rgb = [0, 0, 0];
  colour(ramp, t, rgb, 0);
  return `rgb(${rgb.map((part) => Math.round(255 * part)).join(' ')})`;
}

/** A CSS gradient of the whole ramp. */
export function gradient(ramp: Ramp): string {
  return `linear-gradient(to right, ${RAMPS[ramp].map((_, k, all) => css(ramp, k / (all.length - 1))).join(', ')})`;
}

/** sRGB to the linear numbers in which three.js mixes vertex colours. */
export function linear(part: number): number {
  return part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4;
}
