// Numbers as the reports of hyperstat tell them.

/** A number of six digits, as the reports write it: `0.0500000`, `-12.3457`, `1.23457e8`. */
export function number(value: number | null | undefined, digits = 6): string {
  if (value === null || value === undefined || !Number.isFinite(value)) {
    return '–';
  }
  if (value === 0) {
    return '0';
  }
  const text = value.toExponential(digits - 1).replace('e+', 'e');
  const power = Number(text.split('e')[1]);
  return power >= -2 && power <= 4 ? value.toFixed(Math.max(0, digits - 1 - power)) : text;
}

/** A number of `digits` digits with a prefix of ten to its unit: `0.110 mm`, `1.43 N/µm` stays `1.43 MN/m`. */
export function withPrefix(value: number | null | undefined, unit: string, digits = 4): string {
  if (value === null || value === undefined || !Number.isFinite(value)) {
    return '–';
  }
  if (value === 0) {
    return `0 ${unit}`;
  }
  const size = Math.abs(value);
  const steps: [number, string][] = [
    [1e9, 'G'],
    [1e6, 'M'],
    [1e3, 'k'],
    [1, ''],
    [1e-3, 'm'],
    [1e-6, 'µ'],
    [1e-9, 'n'],
  ];
  const [scale, prefix] = steps.find(([least]) => size >= least * 0.9995) ?? [1e-9, 'n'];
  return `${plain(value / scale, digits)} ${prefix}${unit}`;
}

/** A share as percents, with one decimal as in the budget. */
export function percent(share: number, decimals = 1): string {
  return `${(100 * share).toFixed(decimals)} %`;
}

/** A percentage with its sign, as "What 1 % more changes" tells it. */
export function signed(value: number, decimals = 3): string {
  return `${value >= 0 ? '+' : '−'}${Math.abs(value).toFixed(decimals)} %`;
}

function plain(value: number, digits: number): string {
  const power = Math.floor(Math.log10(Math.abs(Number(value.toPrecision(digits)))) + 1e-12);
  return value.toFixed(Math.max(0, digits - 1 - power)).replace('-', '−');
}

/** What is rounding in a 6×6 matrix beside its diagonal is shown as 0, as in the reports. */
export function withoutRounding(matrix: readonly (readonly number[])[]): number[][] {
  return matrix.map((row, r) =>
    row.map((entry, c) => {
      const scale = Math.sqrt(Math.abs((matrix[r]?.[r] ?? 0) * (matrix[c]?.[c] ?? 0)));
      return Math.abs(entry) < 1e-14 * scale ? 0 : entry;
    }),
  );
}
