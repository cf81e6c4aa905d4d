use nocturne::catalog::Catalogs;
use nocturne::ephemeris::*;
use nocturne::light::night::*;
use nocturne::plan::lay::lay;
use nocturne::render::Renderer;
use nocturne::scene::Scene;
use nocturne::sky::*;
fn main() {
    let r = Renderer::new().unwrap();
    let c = Catalogs::locate(None).unwrap();
    let surface = c.moon_maps().unwrap();
    for (utc, fov, w, h) in
        [("2026-08-22T03:30:00Z", 1.0, 1920, 1080), ("2026-08-22T06:00:00Z", 90.0, 1920, 1080)]
    {
        let mk = |az: f64, alt: f64| {
            format!(
                "nocturne_scene = 1\nutc = \"{utc}\"\n[place]\nlatitude_deg=35.198\nlongitude_deg=-111.651\nheight_m=2106.0\n[camera]\nazimuth_deg={az}\naltitude_deg={alt}\nfield_of_view_deg={fov}\nprojection=\"stereographic\"\nwidth_px={w}\nheight_px={h}\n[layers]\nskylight=false\nground=false\nstars=false\nplanets=false\n"
            )
        };
        let scene = Scene::parse(&mk(0.0, 0.0)).unwrap();
        let set = scene.setting().unwrap();
        let sky =
            SkyState::at(&Ephemeris::analytic(), &set.instant, &set.place, set.tolerance).unwrap();
        let night = Night::of(sky, vec![], &scene.air);
        let m = night.body(Body::Moon).unwrap().apparent;
        let scene = Scene::parse(&mk(m.azimuth().deg(), m.altitude().deg())).unwrap();
        let set = scene.setting().unwrap();
        let (plan, _) = lay(&set, &scene.layers, &night, || Ok(surface.clone())).unwrap();
        let runs: Vec<_> = (0..9).map(|_| r.frame(&plan).unwrap().times).collect();
        print!(
            "fov {fov}: px {:?} bands {}",
            plan.discs.first().and_then(|d| d.globe.as_ref()).map(|g| g.picture_px),
            plan.discs[0].bands.len()
        );
        for (i, p) in runs[0].iter().enumerate() {
            let mut v: Vec<f64> = runs.iter().map(|r| r[i].milliseconds).collect();
            v.sort_by(f64::total_cmp);
            print!("  {} {:.2} (min {:.2})", p.pass, v[4], v[0]);
        }
        println!();
    }
}
