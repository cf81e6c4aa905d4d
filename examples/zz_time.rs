use nocturne::eye::Eye; use nocturne::display::Display; use nocturne::render::*; use nocturne::camera::*; use nocturne::units::Angle; use nocturne::plan::*;
fn main(){
 let r=Renderer::new().unwrap();
 for (w,h) in [(1920u32,1080u32)] {
 let camera=Camera{projection:Projection::Stereographic,field_of_view:Angle::from_deg(90.0),azimuth:Angle::ZERO,altitude:Angle::from_deg(40.0),roll:Angle::ZERO,width_px:w,height_px:h};
 let splats: Vec<Splat>=(0..2000).map(|i|Splat{centre_px:[(i*37%w) as f64,(i*91%h) as f64],illuminance:nocturne::units::Xyzv::new(1.0,1.0,1.0,1.4)*(1e-5/(1.0+i as f64))}).collect();
 let splats: Vec<Splat> = splats;
 for lum in [2e-4,3000.0] {
 let mut sky=SkyPlan::black(Angle::ZERO); for l in &mut sky.dark { *l = nocturne::units::Xyzv::new(0.95,1.0,1.1,2.0)*lum; }
 let plan=FramePlan{camera,sky,milky_way:None,discs:vec![],splats:splats.clone()};
 for acuity in [false] {
 let eye=Eye{acuity,..Eye::default()};
 let mut all: std::collections::BTreeMap<String,Vec<f64>>=Default::default();
 for _ in 0..25 { let t0=std::time::Instant::now(); let c0=cpu(); let l=r.seen(&plan,&eye,&Display::default(),picture::Depth::Codes).unwrap();
   all.entry("zz wall".into()).or_default().push(t0.elapsed().as_secs_f64()*1e3); all.entry("zx cpu".into()).or_default().push(cpu()-c0);
   let mut sums: std::collections::BTreeMap<String,f64>=Default::default();
   for t in l.times { *sums.entry(t.pass).or_default()+=t.milliseconds; }
   let tot:f64=sums.iter().filter(|(k,_)|*k!="sky").map(|(_,v)|v).sum(); sums.insert("zy eye total".into(),tot);
   for (k,v) in sums { all.entry(k).or_default().push(v);} }
 println!("{w}x{h} luminance {lum}");
 for (k,mut v) in all { v.sort_by(f64::total_cmp); println!("  {k:16} median {:7.2} min {:7.2}", v[v.len()/2], v[0]); }
 }}}
}

fn cpu()->f64{ let t=std::fs::read_to_string("/proc/self/schedstat").unwrap(); let _=t; let mut sum=0.0; for d in std::fs::read_dir("/proc/self/task").unwrap(){ if let Ok(x)=std::fs::read_to_string(d.unwrap().path().join("schedstat")) { sum+=x.split(' ').next().unwrap().parse::<f64>().unwrap()/1e6; } } sum }
