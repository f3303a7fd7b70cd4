fn main() {
    let shot = aim_viewer::Shot { out: "/tmp/shot.png".into(), frames: 5, size: [800, 600] };
    aim_viewer::run(aim_viewer::Options { shot: Some(shot), ..Default::default() })
        .map(|told| println!("{told}"))
        .unwrap();
}
