within HydraulicTestBench.Pump;
model MeanFlow "Flow of a pump without its ripple, thesis Eq. 3.48"
  extends Interfaces.PartialPumpFlow;
equation
  QPA = QBar;
  QPB = -QBar;
  tau = alpha/alphaMAX*V_d_max/(2*Constants.pi)*(port_A.p - port_B.p);
  annotation(Documentation(info="<html>
<p>Displacement times speed, and the torque that takes as much power as the oil gets. Its parameters of pistons and
ripple are not used.</p>
<p><b>Source:</b> thesis Eq. 3.48.</p>
<p><b>Valid:</b> speed and angle of either sign, so that it runs as a motor too.</p>
<p><b>Leaves out:</b> ripple; losses, which have slots of their own in <code>A4VSG</code>.</p>
</html>"));
end MeanFlow;
