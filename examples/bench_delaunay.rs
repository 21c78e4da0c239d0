use tetflip::{delaunay::delaunay, mesh::VertexId, predicate::DoublePoints};
fn main() {
    let n: usize = std::env::args().nth(1).unwrap().parse().unwrap();
    let mut s = 1u64;
    let mut r = || {
        s = s
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (s >> 11) as f64 / (1u64 << 53) as f64
    };
    let p: Vec<[f64; 3]> = (0..n).map(|_| [r(), r(), r()]).collect();
    let pts = DoublePoints::new(p);
    let all: Vec<VertexId> = (0..n).map(VertexId::new).collect();
    let t = std::time::Instant::now();
    let o = tetflip::delaunay::insertion_order(&pts, &all);
    println!("order {:?} {}", t.elapsed(), o.len());
    let t = std::time::Instant::now();
    let d = delaunay(&pts, &all).unwrap();
    println!("delaunay {:?} {} tets", t.elapsed(), d.mesh.len());
}
