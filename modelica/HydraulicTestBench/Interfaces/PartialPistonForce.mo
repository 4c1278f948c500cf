within HydraulicTestBench.Interfaces;
partial model PartialPistonForce "Slot for a force on the control piston"
  extends Icons.Slot;
  RealInput x(unit="m") "Position of the piston";
  RealInput v(unit="m/s") "Velocity of the piston";
  RealOutput f(unit="N") "Force on the piston, positive towards positive x";
  annotation(Documentation(info="<html>
<p>The force joins the right-hand side of Eq. 3.9. The law is one equation that gives f; friction has the sign of -v, a
restoring spring that of -x. In the base model f = 0.</p>
<p><b>Source:</b> thesis Eq. 3.9.</p>
<p><b>Used by:</b> <code>pistonForce</code> of <code>Pump.SwashPlateControl</code>.</p>
</html>"));
end PartialPistonForce;
