within HydraulicTestBench.Interfaces;
partial model PartialMotorLoss "Slot for torque lost in the two motors of the test bench"
  extends Icons.Slot;
  Flange_a flange_s "Shaft of the supply motor"
    annotation(Placement(transformation(extent={{-110, -10}, {-90, 10}})));
  Flange_b flange_L "Shaft of the load motor"
    annotation(Placement(transformation(extent={{90, -10}, {110, 10}})));
  RealInput T_s(unit="N.m") "Torque of the supply motor's oil"
    annotation(Placement(transformation(extent={{-20, -20}, {20, 20}}, rotation=-90, origin={-60, 120})));
  RealInput T_L(unit="N.m") "Torque of the load motor's oil"
    annotation(Placement(transformation(extent={{-20, -20}, {20, 20}}, rotation=-90, origin={60, 120})));
  Types.AngularVelocity w_s "Speed of the supply motor";
  Types.AngularVelocity w_L "Speed of the load motor";
  Types.Torque tau_s "Torque lost in the supply motor, with the sign of its speed";
  Types.Torque tau_L "Torque lost in the load motor, with the sign of its speed";
equation
  w_s = der(flange_s.phi);
  w_L = der(flange_L.phi);
  flange_s.tau = tau_s;
  flange_L.tau = tau_L;
  annotation(Documentation(info="<html>
<p>Both motors are of one kind, so one class with one parameter serves both; the law is two equations, for tau_s and
tau_L. In the base model both are 0.</p>
<p><b>Source:</b> thesis Eq. 5.8 and 5.20, beside K p.</p>
<p><b>Used by:</b> <code>motorLoss</code> of <code>LoadCircuit.OpenTestBench</code>.</p>
</html>"));
end PartialMotorLoss;
