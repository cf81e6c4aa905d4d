// Names for what a number measures. WGSL does not check them; the CPU twins do.
alias Radians = f32;
alias Steradians = f32;
alias Pixels = f32;
// X, Y, Z (photopic) and V (scotopic). A result: add it, scale it, never multiply two.
alias LuminanceXyzv = vec4f;    // cd/m2
alias IlluminanceXyzv = vec4f;  // lux

const PI: f32 = 3.14159265358979;
