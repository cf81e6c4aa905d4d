//! A picture in memory: what read-back makes and what export takes.

use crate::units::Xyzv;

/// A rectangle of pixels, row by row from the top left.
#[derive(Debug, Clone, PartialEq)]
pub struct Image<P> {
    width_px: u32,
    height_px: u32,
    pixels: Vec<P>,
}

/// A linear frame in absolute units: X, Y, Z and scotopic V of every pixel, cd/m2.
pub type HdrFrame = Image<[f32; 4]>;

/// Codes of a picture, red, green and blue, as files hold them.
#[derive(Debug, Clone, PartialEq)]
pub enum Codes {
    Eight(Image<[u8; 3]>),
    Sixteen(Image<[u16; 3]>),
}

impl<P: Copy> Image<P> {
    /// All pixels alike.
    pub fn filled(width_px: u32, height_px: u32, pixel: P) -> Self {
        let count = width_px as usize * height_px as usize;
        Image { width_px, height_px, pixels: vec![pixel; count] }
    }
    /// From pixels row by row; `None` when their number does not fit the size.
    pub fn from_pixels(width_px: u32, height_px: u32, pixels: Vec<P>) -> Option<Self> {
        let fits = pixels.len() == width_px as usize * height_px as usize;
        fits.then_some(Image { width_px, height_px, pixels })
    }
    pub fn width_px(&self) -> u32 {
        self.width_px
    }
    pub fn height_px(&self) -> u32 {
        self.height_px
    }
    pub fn pixels(&self) -> &[P] {
        &self.pixels
    }
    pub fn pixels_mut(&mut self) -> &mut [P] {
        &mut self.pixels
    }
    pub fn at(&self, x: u32, y: u32) -> P {
        self.pixels[y as usize * self.width_px as usize + x as usize]
    }
    /// Every pixel through a function.
    pub fn map<Q>(&self, f: impl Fn(P) -> Q) -> Image<Q> {
        Image {
            width_px: self.width_px,
            height_px: self.height_px,
            pixels: self.pixels.iter().map(|&p| f(p)).collect(),
        }
    }
}

impl HdrFrame {
    /// The light of one pixel, cd/m2.
    pub fn xyzv(&self, x: u32, y: u32) -> Xyzv {
        let [x, y, z, v] = self.at(x, y).map(f64::from);
        Xyzv::new(x, y, z, v)
    }
}
