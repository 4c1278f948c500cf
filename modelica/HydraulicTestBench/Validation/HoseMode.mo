within HydraulicTestBench.Validation;
model HoseMode "First resonance of a closed hose, against the closed form"
  extends Icons.Example;
  parameter Integer n = 12 "Segments";
  Hydraulics.Hose hose(
    l=3, d=10e-3, n=n, beta=1.4e9, beta_w=350e6, T_w=0, rho=875, nu=46e-6, roughness=0,
    p(start={p_0*cos(Constants.pi*i/n) for i in 0:n})) "Hose, released from the shape of its first mode"
    annotation(Placement(transformation(extent={{-20, -20}, {20, 20}})));
  parameter Types.Pressure p_0 = 1e5 "Amplitude";
  Types.Pressure p_exact "Closed form at the end";
  Types.Pressure error = hose.port_a.p - p_exact "Difference from the closed form";
  Types.AngularVelocity omega_line = Constants.pi*c/hose.l "Resonance of the unbroken line, c/2l";
  Real energy(final unit="J") "Energy of pressure and motion";
protected
  final parameter Types.Velocity c = sqrt(280e6/hose.rho) "Speed of sound, with 1/1400 + 1/350 = 1/280 MPa";
  final parameter Types.AngularVelocity omega_n = 2*n*c/hose.l*sin(Constants.pi/(2*n)) "Resonance of the segments";
  final parameter Real sigma(final unit="1/s") = 16*hose.nu/hose.d^2 "Decay by laminar friction";
  final parameter Types.AngularVelocity omega_d = sqrt(omega_n^2 - sigma^2) "Damped resonance";
equation
  p_exact = p_0*exp(-sigma*time)*(cos(omega_d*time) + sigma/omega_d*sin(omega_d*time));
  energy = hose.V_l/(2*n*280e6)*(sum(hose.p[i]^2 for i in 1:n + 1) - (hose.p[1]^2 + hose.p[n + 1]^2)/2)
    + hose.rho*hose.l/(2*n*hose.A_l)*sum(hose.q[i]^2 for i in 1:n);
  annotation(
    experiment(StartTime=0, StopTime=0.1, Interval=0.0001, Tolerance=1e-8),
    Documentation(info="<html>
<p>Both ends are closed. In the shape cos(&pi;i/n) the segments swing at 2nc/l sin(&pi;/2n), which is c&pi;/l of the
unbroken line but for the share (&pi;/2n)<sup>2</sup>/6; laminar friction takes 16&nu;/d<sup>2</sup> per second. The
energy falls at all times.</p>
<p><b>Source:</b> wave equation with friction in proportion to the flow, solved by hand for segments.</p>
</html>"));
end HoseMode;
