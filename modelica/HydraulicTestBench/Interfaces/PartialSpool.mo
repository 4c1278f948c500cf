within HydraulicTestBench.Interfaces;
partial model PartialSpool "Slot for the dynamics of the valve spool"
  extends Icons.Slot;
  parameter Types.NaturalFrequency omega_v "Natural frequency";
  parameter Types.DampingRatio zeta_v "Damping ratio";
  RealInput u_ref(unit="1") "Spool command behind the dead time"
    annotation(Placement(transformation(extent={{-140, -20}, {-100, 20}})));
  RealOutput u(unit="1", nominal=1) "Spool position"
    annotation(Placement(transformation(extent={{100, 50}, {120, 70}})));
  RealOutput u_t(unit="1/s", nominal=100) "Spool velocity"
    annotation(Placement(transformation(extent={{100, -10}, {120, 10}})));
  RealOutput u_tt(unit="1/s2") "Spool acceleration"
    annotation(Placement(transformation(extent={{100, -70}, {120, -50}})));
  annotation(Documentation(info="<html>
<p>The law is three equations, for u, u_t and u_tt, with u and u_t as states or bounded by whatever stops the spool. The
card's inner loop and the valve's edges see this u and this u_t.</p>
<p><b>Source:</b> thesis Eq. 3.19.</p>
</html>"));
end PartialSpool;
