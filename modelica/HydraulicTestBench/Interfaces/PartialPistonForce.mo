within HydraulicTestBench.Interfaces;
partial model PartialPistonForce "Slot for a force on the control piston"
  extends Icons.Slot;
  RealInput x(unit="m") "Position of the piston"
    annotation(Placement(transformation(extent={{-140, 40}, {-100, 80}})));
  RealInput v(unit="m/s") "Velocity of the piston"
    annotation(Placement(transformation(extent={{-140, -80}, {-100, -40}})));
  RealOutput f(unit="N") "Force on the piston, positive towards positive x"
    annotation(Placement(transformation(extent={{100, -10}, {120, 10}})));
  annotation(Documentation(info="<html>
<p>The force joins the right-hand side of Eq. 3.9. The law is one equation that gives f; friction has the sign of -v, a
restoring spring that of -x. In the base model f = 0.</p>
<p><b>Source:</b> thesis Eq. 3.9.</p>
<p><b>Used by:</b> <code>pistonForce</code> of <code>Pump.SwashPlateControl</code>.</p>
</html>"));
end PartialPistonForce;
