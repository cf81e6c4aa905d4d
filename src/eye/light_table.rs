//! The light that tables for the GPU are made over: columns by the logarithm of Y, rows by that of the
//! scotopic over the photopic luminance. The shaders know the same numbers (`shaders/lib/light_table.wgsl`).
//!
//! Read with straight lines between its nodes, a table of a power of the light with an exponent between
//! -1 and 1 errs by less than 0.1 %.

/// Y of the first column, log2 of cd/m2, and columns to an octave.
const LOWEST_LOG2: f64 = -30.0;
const COLUMNS_PER_OCTAVE: f64 = 8.0;
/// Columns: up to 2^34 cd/m2.
pub const COLUMNS: usize = 513;
/// V over Y of the first row, log2, and rows to an octave.
const LOWEST_RATIO_LOG2: f64 = -4.0;
const ROWS_PER_OCTAVE: f64 = 2.0;
/// Rows: up to 16.
pub const ROWS: usize = 17;

/// Photopic luminance of a column, cd/m2.
pub fn photopic_cd_m2(column: usize) -> f64 {
    (LOWEST_LOG2 + column as f64 / COLUMNS_PER_OCTAVE).exp2()
}

/// The column nearest to a photopic luminance, cd/m2.
pub fn column(photopic_cd_m2: f64) -> usize {
    let place = (photopic_cd_m2.max(1e-10).log2() - LOWEST_LOG2) * COLUMNS_PER_OCTAVE;
    (place.round().max(0.0) as usize).min(COLUMNS - 1)
}

/// Scotopic over photopic luminance of a row.
pub fn scotopic_ratio(row: usize) -> f64 {
    (LOWEST_RATIO_LOG2 + row as f64 / ROWS_PER_OCTAVE).exp2()
}

/// Something for each photopic and scotopic luminance of the table, cd/m2, row by row.
pub fn table<T>(of: impl Fn(f64, f64) -> T) -> Vec<T> {
    (0..ROWS * COLUMNS)
        .map(|node| {
            let photopic = photopic_cd_m2(node % COLUMNS);
            of(photopic, photopic * scotopic_ratio(node / COLUMNS))
        })
        .collect()
}

/// What a table holds for a light of photopic and scotopic luminances in cd/m2, straight between nodes.
pub fn at(table: &[[f32; 4]], photopic_cd_m2: f64, scotopic_cd_m2: f64) -> [f64; 4] {
    const DARKEST: f64 = 1e-10;
    let photopic = photopic_cd_m2.max(DARKEST);
    let ratio = scotopic_cd_m2.max(DARKEST) / photopic;
    let place = |value: f64, lowest: f64, per_octave: f64, nodes: usize| {
        let place = ((value.log2() - lowest) * per_octave).clamp(0.0, (nodes - 1) as f64);
        let node = (place as usize).min(nodes - 2);
        (node, place - node as f64)
    };
    let (column, along) = place(photopic, LOWEST_LOG2, COLUMNS_PER_OCTAVE, COLUMNS);
    let (row, up) = place(ratio, LOWEST_RATIO_LOG2, ROWS_PER_OCTAVE, ROWS);
    let node = |row: usize, column: usize| table[row * COLUMNS + column].map(f64::from);
    let [low, high] = [row, row + 1].map(|row| {
        let [near, far] = [node(row, column), node(row, column + 1)];
        [0, 1, 2, 3].map(|part: usize| near[part] + along * (far[part] - near[part]))
    });
    [0, 1, 2, 3].map(|part: usize| low[part] + up * (high[part] - low[part]))
}
