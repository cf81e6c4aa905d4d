//! Words by the things they name, none over another.
//!
//! The most important is laid first. Each tries the places around its object, the one that it had before
//! first, and is left out where all are taken: so words stay where they are while the sky moves a little.

use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};

use eframe::egui::{Align2, Pos2, Rect, Vec2, pos2};

/// No more words than these at once.
pub const MOST: usize = 250;
/// Room around each, points.
const ROOM: f32 = 2.0;
/// Size of the cells in which neighbours are looked for, points.
const CELL: Vec2 = Vec2::new(80.0, 32.0);

/// What is not to be mixed up with another from frame to frame.
pub type Id = u64;

/// The same number for the same thing.
pub fn id(thing: impl Hash) -> Id {
    let mut hasher = DefaultHasher::new();
    thing.hash(&mut hasher);
    hasher.finish()
}

/// Words that wish for a place.
#[derive(Debug, Clone, PartialEq)]
pub struct Label {
    pub id: Id,
    pub text: String,
    /// What it names, points of the window.
    pub at: Pos2,
    /// From there to the words, points.
    pub gap: f32,
    pub places: &'static [Align2],
    /// Size of the letters, points.
    pub size: f32,
    /// Between letters, points.
    pub spacing: f32,
    /// sRGB.
    pub colour: [u8; 3],
    pub opacity: f32,
    /// The least is laid first.
    pub rank: f32,
}

/// Right, left, above or below.
pub const AROUND: &[Align2] =
    &[Align2::LEFT_CENTER, Align2::RIGHT_CENTER, Align2::CENTER_BOTTOM, Align2::CENTER_TOP];
/// On it, and nowhere else.
pub const ON: &[Align2] = &[Align2::CENTER_CENTER];
/// On it, else around.
pub const ON_OR_AROUND: &[Align2] = &[
    Align2::CENTER_CENTER,
    Align2::LEFT_CENTER,
    Align2::RIGHT_CENTER,
    Align2::CENTER_BOTTOM,
    Align2::CENTER_TOP,
];

/// Words that have a place.
#[derive(Debug, Clone)]
pub struct Placed<G> {
    pub label: Label,
    pub rect: Rect,
    /// What they were measured with.
    pub galley: G,
}

/// Which place each had.
#[derive(Debug, Default)]
pub struct Memory {
    places: HashMap<Id, usize>,
}

/// Lays labels within an area, given what measures them.
pub fn place<G>(
    mut labels: Vec<Label>,
    area: Rect,
    memory: &mut Memory,
    mut measure: impl FnMut(&Label) -> (Vec2, G),
) -> Vec<Placed<G>> {
    labels.sort_by(|a, b| a.rank.total_cmp(&b.rank));
    let mut taken = Taken::default();
    let mut placed: Vec<Placed<G>> = Vec::new();
    let mut places = HashMap::new();
    for label in labels {
        if placed.len() == MOST {
            break;
        }
        if !area.contains(label.at) || places.contains_key(&label.id) {
            continue;
        }
        let (size, galley) = measure(&label);
        let before = memory.places.get(&label.id).copied().filter(|&n| n < label.places.len());
        let order =
            before.into_iter().chain((0..label.places.len()).filter(|&n| Some(n) != before));
        let found = order.into_iter().find_map(|number| {
            let rect = beside(label.at, label.places[number], size, label.gap);
            (area.contains_rect(rect) && taken.is_free(rect)).then_some((number, rect))
        });
        if let Some((number, rect)) = found {
            taken.add(rect);
            places.insert(label.id, number);
            placed.push(Placed { label, rect, galley });
        }
    }
    memory.places = places;
    placed
}

/// The box of words of a size, of which the part that `align` names is next to a point.
fn beside(at: Pos2, align: Align2, size: Vec2, gap: f32) -> Rect {
    let sign = align.to_sign();
    // Aligned to the left, words stand to the right of the point.
    let moved = at - gap * sign;
    align.anchor_size(moved, size)
}

/// Boxes that are taken.
#[derive(Default)]
struct Taken {
    boxes: Vec<Rect>,
    cells: HashMap<(i32, i32), Vec<usize>>,
}

impl Taken {
    fn is_free(&self, rect: Rect) -> bool {
        let wanted = rect.expand(ROOM);
        cells(wanted).all(|cell| {
            let held = self.cells.get(&cell).map_or(&[][..], Vec::as_slice);
            held.iter().all(|&other| !self.boxes[other].intersects(wanted))
        })
    }

    fn add(&mut self, rect: Rect) {
        for cell in cells(rect) {
            self.cells.entry(cell).or_default().push(self.boxes.len());
        }
        self.boxes.push(rect);
    }
}

fn cells(rect: Rect) -> impl Iterator<Item = (i32, i32)> {
    let cell = |point: Pos2| pos2((point.x / CELL.x).floor(), (point.y / CELL.y).floor());
    let (low, high) = (cell(rect.min), cell(rect.max));
    let columns = low.x as i32..=high.x as i32;
    columns.flat_map(move |x| (low.y as i32..=high.y as i32).map(move |y| (x, y)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn label(number: u32, at: Pos2, rank: f32) -> Label {
        Label {
            id: id(number),
            text: format!("Star {number}"),
            at,
            gap: 5.0,
            places: AROUND,
            size: 12.0,
            spacing: 0.0,
            colour: [255; 3],
            opacity: 1.0,
            rank,
        }
    }

    fn measured(label: &Label) -> (Vec2, ()) {
        (Vec2::new(0.5 * label.size * label.text.len() as f32, label.size), ())
    }

    #[test]
    fn words_stand_beside_their_points() {
        let size = Vec2::new(20.0, 10.0);
        let rect = |align| beside(pos2(100.0, 50.0), align, size, 4.0);
        assert_eq!(rect(Align2::LEFT_CENTER).min, pos2(104.0, 45.0));
        assert_eq!(rect(Align2::RIGHT_CENTER).max, pos2(96.0, 55.0));
        assert_eq!(rect(Align2::CENTER_BOTTOM).max, pos2(110.0, 46.0));
        assert_eq!(rect(Align2::CENTER_TOP).min, pos2(90.0, 54.0));
        assert_eq!(rect(Align2::CENTER_CENTER).center(), pos2(100.0, 50.0));
    }

    #[test]
    fn words_never_pile_and_the_first_wins() {
        let area = Rect::from_min_size(Pos2::ZERO, Vec2::new(640.0, 360.0));
        // A pseudo-random crowd, denser than there is room for.
        let mut state = 1u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 40) as f32 / (1u64 << 24) as f32
        };
        for _ in 0..20 {
            let crowd: Vec<Label> = (0..600)
                .map(|n| label(n, pos2(random() * 640.0, random() * 360.0), n as f32))
                .collect();
            let placed = place(crowd, area, &mut Memory::default(), measured);
            assert!(placed.len() > 100 && placed.len() <= MOST, "{}", placed.len());
            assert_eq!(placed[0].label.id, id(0u32));
            for (index, one) in placed.iter().enumerate() {
                assert!(area.contains_rect(one.rect));
                assert!(placed[..index].iter().all(|other| !other.rect.intersects(one.rect)));
            }
        }
    }

    #[test]
    fn a_label_keeps_its_place() {
        let area = Rect::from_min_size(Pos2::ZERO, Vec2::new(640.0, 360.0));
        let mut memory = Memory::default();
        let lay = |memory: &mut Memory, x: f32, is_crowded: bool| {
            let mut all = vec![label(1, pos2(x, 100.0), 1.0)];
            if is_crowded {
                all.push(label(2, pos2(x + 10.0, 100.0), 0.0));
            }
            let placed = place(all, area, memory, measured);
            placed.iter().find(|one| one.label.id == id(1u32)).map(|one| one.rect.center().x - x)
        };
        // Another takes the right side; the left one is kept when the other is gone.
        let crowded = lay(&mut memory, 300.0, true).unwrap();
        let alone = lay(&mut memory, 303.0, false).unwrap();
        assert!(crowded < 0.0 && (alone - crowded).abs() < 1e-3, "{crowded} {alone}");
        assert!(lay(&mut Memory::default(), 303.0, false).unwrap() > 0.0);
    }
}
