within HydraulicTestBench.Examples;
model RippleHose "Ripple of the pump before and after 3 m of hose"
  extends Icons.Example;
  Mechanics.ConstantSpeed drive(w=1450*2*Constants.pi/60) "Drive"
    annotation(Placement(transformation(extent={{-100, -10}, {-80, 10}})));
  Pump.A4VSG pump "Pump with simplified ripple"
    annotation(Placement(transformation(extent={{-60, -20}, {-20, 20}})));
  Hydraulics.FlowSensor before "Flow that the pump gives"
    annotation(Placement(transformation(extent={{-30, 40}, {-10, 60}})));
  Hydraulics.Hose hose(l=3, d=10e-3, n=32, beta=1.4e9, beta_w=350e6, T_w=1e-4, rho=875) "Hose"
    annotation(Placement(transformation(extent={{0, 40}, {20, 60}})));
  Hydraulics.FlowSensor after "Flow that arrives"
    annotation(Placement(transformation(extent={{30, 40}, {50, 60}})));
  Hydraulics.Tank outlet "Tank behind the hose"
    annotation(Placement(transformation(extent={{60, 20}, {80, 40}})));
  Hydraulics.Tank inlet "Tank at port B"
    annotation(Placement(transformation(extent={{-10, -10}, {10, 10}})));
  Hydraulics.Tank drain "Drain"
    annotation(Placement(transformation(extent={{-50, -60}, {-30, -40}})));
equation
  pump.alphaCMD = 50;
  pump.alphaCMD_t = 0;
  connect(drive.flange, pump.shaft);
  connect(pump.port_A, before.port_a);
  connect(before.port_b, hose.port_a);
  connect(hose.port_b, after.port_a);
  connect(after.port_b, outlet.port);
  connect(pump.port_B, inlet.port);
  connect(pump.port_D, drain.port);
  annotation(
    experiment(StartTime=0, StopTime=0.4, Interval=0.0001, Tolerance=1e-7),
    Documentation(info="<html>
<p>Plot <code>before.Q</code> and <code>after.Q</code>. The case <code>ripple</code> of the validation gives the
attenuation as a number, over the segments and the damping of the hose's wall.</p>
<p><b>Source:</b> thesis Section 4.5, Fig. 4.8 and 4.9: hose of 3 m and 10 mm. The thesis gives neither angle, wall nor
damping of the hose: 50 percent as in Fig. 4.10, a wall of 350 MPa and a loss factor of 0.27 at the ripple's 435 Hz are
this library's choice.</p>
<p><b>Reading:</b> a quarter of the ripple arrives. A hose of one segment is a low pass that lets one percent through
however its wall is damped, which may be what Fig. 4.9 shows. A real line has resonances, and without damping even
between two of them its open end gives out as much ripple as goes in: what takes the ripple away is the damping of the
wall, and a load at the end, not the length.</p>
</html>"));
end RippleHose;
