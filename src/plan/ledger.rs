//! What was drawn, what was not, and why.

/// One layer of the picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    pub layer: &'static str,
    pub drawn: usize,
    /// Reasons, and how many things each of them spared.
    pub skipped: Vec<(&'static str, usize)>,
    /// How it is drawn, where there is a choice.
    pub how: Vec<String>,
}

/// The layers, in the order in which they are drawn.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Ledger {
    pub entries: Vec<Entry>,
}

impl Ledger {
    /// Notes that something of a layer is drawn.
    pub fn draw(&mut self, layer: &'static str) {
        self.draw_many(layer, 1);
    }

    /// The same for many things at once.
    pub fn draw_many(&mut self, layer: &'static str, many: usize) {
        self.entry(layer).drawn += many;
    }

    /// Notes how something of a layer is drawn.
    pub fn tell(&mut self, layer: &'static str, how: String) {
        self.entry(layer).how.push(how);
    }

    /// Notes that something of a layer is not drawn.
    pub fn skip(&mut self, layer: &'static str, reason: &'static str) {
        self.skip_many(layer, reason, 1);
    }

    /// The same for many things at once; nothing is noted of none.
    pub fn skip_many(&mut self, layer: &'static str, reason: &'static str, many: usize) {
        let skipped = &mut self.entry(layer).skipped;
        match skipped.iter_mut().find(|(known, _)| *known == reason) {
            Some((_, count)) => *count += many,
            None if many == 0 => {}
            None => skipped.push((reason, many)),
        }
    }

    /// What is known of a layer.
    pub fn of(&self, layer: &str) -> Option<&Entry> {
        self.entries.iter().find(|entry| entry.layer == layer)
    }

    fn entry(&mut self, layer: &'static str) -> &mut Entry {
        let index = match self.entries.iter().position(|entry| entry.layer == layer) {
            Some(index) => index,
            None => {
                self.entries.push(Entry { layer, drawn: 0, skipped: Vec::new(), how: Vec::new() });
                self.entries.len() - 1
            }
        };
        &mut self.entries[index]
    }
}
