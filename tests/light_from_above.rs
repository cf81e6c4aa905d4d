use nocturne::air::Atmosphere;
use nocturne::air::scattering::above::*;
use nocturne::units::Angle;
use std::time::Instant;

#[test]
fn explore() {
    let uniform = |_: f64, _: f64| 1.0;
    for name in ["mol", "haze"] {
        let mut air = Atmosphere::default().straight();
        if name == "mol" {
            air.aerosol.optical_depth_550 = 0.0
        }
        air.ozone.column_du = 0.0;
        air.aerosol.single_scattering_albedo = 1.0;
        air.ground.albedo = 1.0;
        let q = DiffuseQuality { order: 0, ..DiffuseQuality::RENDER };
        let t = Instant::now();
        let tables = DiffuseTables::solve(&air, 0.0, &[400.0, 550.0], q).unwrap();
        println!("solve {:?}", t.elapsed());
        let t = Instant::now();
        let field = tables.lit_from(uniform);
        println!("field {:?}", t.elapsed());
        println!(
            "ground {:?}",
            field.ground_irradiance().iter().map(|e| e / std::f64::consts::PI).collect::<Vec<_>>()
        );
        let mut worst = 0.0f64;
        for h in [0.0, 3.0, 20.0] {
            for e in -90..=90 {
                let (mut a, mut b) = ([0.0; 2], [0.0; 2]);
                let e = Angle::from_deg(f64::from(e) + 0.01);
                field.radiance(h, e, Angle::ZERO, &mut a);
                tables.transmittance(h, e, &mut b);
                for i in 0..2 {
                    worst = worst.max((a[i] + b[i] - 1.0).abs());
                }
            }
        }
        println!("{name} worst {worst:e}");
    }
    let want = [
        [[0.703, 0.190], [0.494, 0.299], [0.137, 0.438], [0.001, 0.405]],
        [[0.798, 0.119], [0.638, 0.197], [0.284, 0.345], [0.009, 0.422]],
        [[0.863, 0.088], [0.745, 0.150], [0.437, 0.287], [0.042, 0.443]],
    ];
    let air = Atmosphere::default().straight();
    for degree in [2, 4, 6, 8, 10, 12, 16, 24] {
        let q = DiffuseQuality { order: 0, degree, ..DiffuseQuality::RENDER };
        let t = Instant::now();
        let tables = DiffuseTables::solve(&air, 0.0, &[450.0, 550.0, 650.0], q).unwrap();
        let t1 = t.elapsed();
        for (name, field) in
            [("uni", tables.lit_from(uniform)), ("glow", tables.lit_from(glowing_layer(90.0)))]
        {
            print!("deg {degree} {name} {t1:?}");
            for w in 0..3 {
                for (k, e) in [90.0, 30.0, 10.0, 2.0].into_iter().enumerate() {
                    let (mut a, mut b) = ([0.0; 3], [0.0; 3]);
                    let e = Angle::from_deg(e);
                    field.radiance(0.001, e, Angle::ZERO, &mut a);
                    tables.transmittance(0.001, e, &mut b);
                    if degree == 24 && name == "uni" {
                        print!(" [{} {}]", want[w][k][0], want[w][k][1]);
                        print!("({:.4})", b[w])
                    }
                    print!(" {:.4}", a[w]);
                }
            }
            println!();
        }
    }
    let t = Instant::now();
    let tables =
        DiffuseTables::solve(&air, 0.0, &[450.0, 550.0, 650.0], DiffuseQuality::RENDER).unwrap();
    println!("all orders {:?}", t.elapsed());
    let mut sky = SkyHarmonics::uniform(1.0);
    for l in 0..=8 {
        for m in 0..=l {
            sky.add(l, m, (0.01, 0.02))
        }
    }
    let t = Instant::now();
    let field = tables.lit_by(&sky);
    println!("field all orders {:?}", t.elapsed());
    let t = Instant::now();
    let mut a = [0.0; 3];
    for e in 0..97 {
        field.radiance(0.0, Angle::from_deg(f64::from(e) * 0.9), Angle::ZERO, &mut a);
    }
    println!("97 rows {:?}", t.elapsed());
}
