//! The light that tables for the GPU are made over: columns by the logarithm of Y, rows by that of the
//! scotopic over the photopic luminance. The shaders know the same numbers (`shaders/lib/light_table.wgsl`).
//!
//! Read with straight lines between its nodes, a table of a power of Y with an exponent between -1 and 1 errs
//! by less than 0.1 %. Rows stand farther apart: what grows with V itself is to be tabled per V/Y.

/// Y of the first column, log2 of cd/m2, and columns to an octave.
pub const LOWEST_LOG2: f64 = -30.0;
pub const COLUMNS_PER_OCTAVE: f64 = 8.0;
/// Columns: up to 2^34 cd/m2.
pub const COLUMNS: usize = 513;
/// V over Y of the first row, log2, and rows to an octave.
pub const LOWEST_RATIO_LOG2: f64 = -4.0;
pub const ROWS_PER_OCTAVE: f64 = 4.0;
/// Rows: up to 16.
pub const ROWS: usize = 33;

/// Photopic luminance of a column, cd/m2.
pub fn photopic_cd_m2(column: usize) -> f64 {
    (LOWEST_LOG2 + column as f64 / COLUMNS_PER_OCTAVE).exp2()
}

/// No light is darker to the tables, cd/m2.
pub const DARKEST_CD_M2: f64 = 1e-10;

/// Scotopic over photopic luminance of a light in cd/m2, no more than the tables have.
pub fn ratio(photopic_cd_m2: f64, scotopic_cd_m2: f64) -> f64 {
    let ratio = scotopic_cd_m2.max(DARKEST_CD_M2) / photopic_cd_m2.max(DARKEST_CD_M2);
    ratio.min(scotopic_ratio(ROWS - 1))
}

/// The column nearest to a photopic luminance, cd/m2.
pub fn column(photopic_cd_m2: f64) -> usize {
    let place = (photopic_cd_m2.max(DARKEST_CD_M2).log2() - LOWEST_LOG2) * COLUMNS_PER_OCTAVE;
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
    let photopic = photopic_cd_m2.max(DARKEST_CD_M2);
    let ratio = ratio(photopic_cd_m2, scotopic_cd_m2);
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_and_rows_are_where_they_say() {
        for n in 0..COLUMNS {
            assert_eq!(column(photopic_cd_m2(n)), n);
        }
        assert_eq!(column(0.0), 0);
        assert_eq!(column(1e30), COLUMNS - 1);
        let of_node = table(|photopic, scotopic| [photopic as f32, scotopic as f32, 0.0, 1.0]);
        for (n, node) in of_node.iter().enumerate().step_by(101) {
            let [photopic, scotopic] = [node[0], node[1]].map(f64::from);
            let read = at(&of_node, photopic, scotopic);
            if (1e-8..1e8).contains(&photopic) && scotopic > 1e-9 {
                assert!((read[0] / photopic - 1.0).abs() < 1e-5, "{n}: {read:?} {node:?}");
                assert!((read[1] / scotopic - 1.0).abs() < 1e-5, "{n}: {read:?} {node:?}");
            }
        }
    }

    #[test]
    fn powers_are_read_to_a_thousandth() {
        for exponent in [-1.0, -0.5, 0.3, 1.0] {
            let powers = table(|photopic, _| [photopic.powf(exponent) as f32; 4]);
            for step in 0..400 {
                let y = 1e-6 * 1.07f64.powi(step);
                let read = at(&powers, y, 1.7 * y)[0];
                assert!((read / y.powf(exponent) - 1.0).abs() < 1e-3, "{exponent} {y}: {read}");
            }
        }
    }
}
