model Machine "What stands on the floor"
  extends Drive.Axis(
    m=43, d=1.6e3, J=6.2e-4,
    redeclare Drive.Effects.GuidewayFriction guideway(F_c=60));
end Machine;
