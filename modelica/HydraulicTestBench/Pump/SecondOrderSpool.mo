within HydraulicTestBench.Pump;
model SecondOrderSpool "Spool of the proportional valve as a second order lag, thesis Eq. 3.19"
  extends Interfaces.PartialSpool(
    u(start=0, fixed=true, stateSelect=StateSelect.always),
    u_t(start=0, fixed=true, stateSelect=StateSelect.always));
equation
  der(u) = u_t;
  der(u_t) = u_tt;
  u_tt = omega_v^2*(u_ref - u) - 2*zeta_v*omega_v*u_t;
  annotation(Documentation(info="<html>
<p>d<sup>2</sup>u/dt<sup>2</sup> = &omega;<sub>v</sub><sup>2</sup>(u<sub>ref</sub> - u) -
2&zeta;<sub>v</sub>&omega;<sub>v</sub> du/dt.</p>
<p><b>Source:</b> thesis Eq. 3.19.</p>
<p><b>Valid:</b> small and medium amplitudes, as in a data sheet's Bode plot.</p>
<p><b>Leaves out:</b> limits of position and speed of the spool, friction, flow forces.</p>
</html>"));
end SecondOrderSpool;
