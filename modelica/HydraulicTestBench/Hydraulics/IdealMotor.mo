within HydraulicTestBench.Hydraulics;
model IdealMotor "Motor of variable displacement without losses, thesis Eq. 5.7 to 5.9"
  extends Icons.Component;
  parameter Types.Volume V_max(min=1e-9) "Displacement per revolution at the largest angle";
  parameter Types.Angle alphaMAX(min=0.01) "Largest angle";
  Interfaces.Port_a port_A "Inlet at positive speed and angle"
    annotation(Placement(transformation(extent={{-110, 50}, {-90, 70}})));
  Interfaces.Port_b port_B "Outlet at positive speed and angle"
    annotation(Placement(transformation(extent={{-110, -70}, {-90, -50}})));
  Interfaces.Flange_b shaft "Shaft"
    annotation(Placement(transformation(extent={{90, -10}, {110, 10}})));
  Interfaces.RealInput alpha(unit="rad") "Angle of the bent axis or swash plate"
    annotation(Placement(transformation(extent={{-20, -20}, {20, 20}}, rotation=-90, origin={0, 120})));
  Real K(final unit="m3/rad", nominal=1e-5) "Displacement per radian, Eq. 5.9";
  Types.AngularVelocity omega "Speed";
  Types.VolumeFlowRate Q "Flow from A to B, Eq. 5.7";
  Types.Torque tau "Torque of the oil on the shaft, Eq. 5.8";
equation
  K = alpha/alphaMAX*V_max/(2*Constants.pi);
  omega = der(shaft.phi);
  Q = K*omega;
  tau = K*(port_A.p - port_B.p);
  port_A.q = Q;
  port_B.q = -Q;
  shaft.tau = -tau;
  annotation(Documentation(info="<html>
<p>Q = K&omega; and T = K(p<sub>A</sub> - p<sub>B</sub>) with K = &alpha;/&alpha;<sub>max</sub> V<sub>max</sub>/2&pi;.
The same K in both: all hydraulic power comes out at the shaft.</p>
<p><b>Source:</b> thesis Eq. 5.7 to 5.9 and 5.19 to 5.22.</p>
<p><b>Valid:</b> any speed, pressures and angle, as a motor and as a pump.</p>
<p><b>Leaves out:</b> losses, inertia, ripple; <code>VariableMotor</code> has slots for losses.</p>
</html>"));
end IdealMotor;
