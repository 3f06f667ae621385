#[path = "it/effects"]
mod effects {
    mod reference;
    mod nonlinear; mod waves; mod friction; mod bouncing; mod faces; mod stops; mod separation;
    mod trial;
}
