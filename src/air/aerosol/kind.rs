//! The shipped kinds of aerosol: extinction, albedo and phase function by wavelength.
//!
//! Tables of `cargo run --bin pack`: Lorenz-Mie theory for mixtures of spheres (`src/bin/pack/aerosols.rs`
//! says which, and from where). Ten wavelengths from 360 to 830 nm, 241 angles. Between wavelengths
//! the extinction follows a power law, albedo and phase function are linear; between angles the
//! logarithm of the phase function is linear.
//!
//! Omitted: shapes other than spheres, of which dust has many; humidity other than that of the table.
//!
//! Accuracy: phase functions between the angles within 0.3 % (`clear`, `continental`), 0.8 %
//! (`desert`, `volcanic`), 2 % (`maritime`, in its rainbow and glory); extinction and albedo at
//! 550 nm are those of OPAC's own table within its last digit.

use std::sync::LazyLock;

use serde::{Deserialize, Serialize};

use crate::air::phase::Tabulated;

/// What an aerosol consists of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MieKind {
    /// Land far from towns: sulphates and a little soil; OPAC continental clean, 80 % humidity.
    Clear,
    /// Inhabited land: soot too; OPAC continental average, 80 % humidity.
    Continental,
    /// Open sea: sea salt; OPAC maritime clean, 80 % humidity.
    Maritime,
    /// Mineral dust; OPAC desert, 50 % humidity.
    Desert,
    /// Droplets of sulphuric acid in the stratosphere, some months after a great eruption.
    Volcanic,
}

/// One kind, read.
#[derive(Debug)]
pub(super) struct Table {
    wavelengths_nm: Vec<f64>,
    /// Relative to that at 550 nm.
    extinction: Vec<f64>,
    albedo: Vec<f64>,
    phases: Vec<Tabulated>,
}

static TABLES: LazyLock<[Table; 5]> = LazyLock::new(|| {
    [
        include_str!("../../../catalogs/air/mie_clear.csv"),
        include_str!("../../../catalogs/air/mie_continental.csv"),
        include_str!("../../../catalogs/air/mie_maritime.csv"),
        include_str!("../../../catalogs/air/mie_desert.csv"),
        include_str!("../../../catalogs/air/mie_volcanic.csv"),
    ]
    .map(Table::parse)
});

impl MieKind {
    /// All kinds.
    pub const ALL: [MieKind; 5] = [
        MieKind::Clear,
        MieKind::Continental,
        MieKind::Maritime,
        MieKind::Desert,
        MieKind::Volcanic,
    ];

    pub(super) fn table(self) -> &'static Table {
        &TABLES[self as usize]
    }
}

impl Table {
    /// A table that is compiled in: tests read every one.
    fn parse(csv: &str) -> Table {
        let number = |cell: &str| cell.parse::<f64>().expect("a shipped table holds numbers");
        let mut rows = csv.lines().map(|line| line.split_once(',').expect("a shipped row"));
        let mut row = |name: &str| -> Vec<f64> {
            let (head, cells) = rows.next().expect("a shipped head");
            assert_eq!(head, name, "a shipped table begins with other rows");
            cells.split(',').map(number).collect()
        };
        let (wavelengths_nm, extinction) = (row("wavelength_nm"), row("extinction"));
        let albedo = row("albedo");
        let mut degrees = Vec::new();
        let mut values = vec![Vec::new(); wavelengths_nm.len()];
        for (angle, cells) in rows {
            degrees.push(number(angle));
            values.iter_mut().zip(cells.split(',')).for_each(|(v, cell)| v.push(number(cell)));
        }
        let phase = |values| Tabulated::new(degrees.clone(), values).expect("a shipped phase");
        let phases = values.into_iter().map(phase).collect();
        Table { wavelengths_nm, extinction, albedo, phases }
    }

    /// The lower node of the interval of a wavelength, and where in it.
    fn place(&self, wavelength_nm: f64) -> (usize, f64) {
        let nodes = &self.wavelengths_nm;
        let i = nodes.partition_point(|&node| node <= wavelength_nm).clamp(1, nodes.len() - 1);
        (i - 1, ((wavelength_nm - nodes[i - 1]) / (nodes[i] - nodes[i - 1])).clamp(0.0, 1.0))
    }

    /// Relative to that at 550 nm.
    pub fn extinction(&self, wavelength_nm: f64) -> f64 {
        let (i, _) = self.place(wavelength_nm);
        let (low, high) = (self.wavelengths_nm[i], self.wavelengths_nm[i + 1]);
        let (from, to) = (self.extinction[i], self.extinction[i + 1]);
        let exponent = (to / from).ln() / (high / low).ln();
        from * (wavelength_nm / low).powf(exponent)
    }

    pub fn albedo(&self, wavelength_nm: f64) -> f64 {
        let (i, t) = self.place(wavelength_nm);
        self.albedo[i] + (self.albedo[i + 1] - self.albedo[i]) * t
    }

    pub fn phase(&self, wavelength_nm: f64, cosine: f64) -> f64 {
        self.mix(wavelength_nm, |phase| phase.value(cosine))
    }

    pub fn moment(&self, wavelength_nm: f64, l: usize) -> f64 {
        self.mix(wavelength_nm, |phase| phase.moment(l))
    }

    fn mix(&self, wavelength_nm: f64, value: impl Fn(&Tabulated) -> f64) -> f64 {
        let (i, t) = self.place(wavelength_nm);
        match t {
            0.0 => value(&self.phases[i]),
            1.0 => value(&self.phases[i + 1]),
            _ => value(&self.phases[i]) * (1.0 - t) + value(&self.phases[i + 1]) * t,
        }
    }
}
